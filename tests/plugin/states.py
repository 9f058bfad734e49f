# SPDX-License-Identifier: BSD-3-Clause
"""A state file brings back every property of every node as it was, to the last bit, whatever the values are."""
import math
import os
import random

import plugin
import proxies
from paraview import simple

ROUNDS = 4
# Numbers that a careless writer loses: long ones, the largest and smallest, whole ones.
ODD = [0.1, 1 / 3, -math.pi, 1e-300, -1.7976931348623157e308, 5e-324, 1e22, 123456789.123456789, 0.0, 2.0**53 + 2]


def inputs(proxy):
    """Number of connections each input takes: {name: 1 or 2}."""
    for key in set(proxies.input_names(proxy)):
        yield key, 2 if proxy.GetProperty(key).GetMultipleInput() else 1


def odd_value(prop, dice):
    """Elements that the panel or a script could have set, in the domain or not."""
    if prop.FindDomain("vtkSMBooleanDomain"):
        return [dice.choice([0, 1])]
    if prop.FindDomain("vtkSMEnumerationDomain"):
        domain = prop.FindDomain("vtkSMEnumerationDomain")
        return [domain.GetEntryValue(dice.randrange(domain.GetNumberOfEntries()))]
    count = prop.GetNumberOfElements()
    if prop.GetRepeatCommand():
        count = prop.GetNumberOfElementsPerCommand() * dice.randrange(4)
    if prop.IsA("vtkSMStringVectorProperty"):  # the name of an array stands last
        fixed = [prop.GetElement(k) for k in range(count - 1)]
        return fixed + [dice.choice(["", "Radius", "a b", "<&\"'>", "\u00e9\u4e2d"])]
    if prop.IsA("vtkSMIntVectorProperty"):
        return [dice.choice([0, 2, 64, -1, 2**31 - 1]) for _ in range(count)]
    return [dice.choice(ODD) if dice.random() < 0.7 else dice.uniform(-10, 10) for _ in range(count)]


def values(proxy):
    """name: elements, of every property that is not an input."""
    return {
        key: [prop.GetElement(k) for k in range(prop.GetNumberOfElements())]
        for key, prop in proxies.properties(proxy)
        if not proxies.is_input(prop)
    }


def make(name, ball, cube, dice):
    """A node with odd values; nothing is run."""
    prototype = plugin.new_proxy(name)
    connections = {key: [ball, cube][:count] for key, count in inputs(prototype)}
    node = getattr(plugin, name)(registrationName=name, **connections)
    for _, prop in proxies.properties(node.SMProxy):
        if proxies.is_input(prop):
            continue
        elements = odd_value(prop, dice)
        prop.SetNumberOfElements(len(elements))
        for index, element in enumerate(elements):
            prop.SetElement(index, element)
    node.SMProxy.UpdateVTKObjects()
    return node


def check_round(seed, folder):
    dice = random.Random(seed)
    ball, cube = simple.Sphere(registrationName="Ball"), simple.Box(registrationName="Cube")
    nodes = {name: make(name, ball, cube, dice) for name in plugin.PROXIES}
    before = {name: values(node.SMProxy) for name, node in nodes.items()}
    pushed = {name: proxies.printed(node.SMProxy) for name, node in nodes.items()}
    path = os.path.join(folder, f"{seed}.pvsm")
    simple.SaveState(path)
    del nodes, ball, cube
    simple.ResetSession()
    simple.LoadState(path)
    for name, expected in before.items():
        proxy = simple.FindSource(name).SMProxy
        found = values(proxy)
        assert found == expected, f"{name}, seed {seed}: {set(map(str, found.items())) ^ set(map(str, expected.items()))}"
        now = proxies.printed(proxy)
        for key in found:
            assert now.get(key) == pushed[name].get(key), f"{name}, seed {seed}: the VTK object's {key} is {now[key]}"
        for key, count in inputs(proxy):
            upstream = [proxy.GetProperty(key).GetProxy(k).GetXMLName() for k in range(count)]
            assert upstream == ["SphereSource", "CubeSource"][:count], f"{name}.{key}: {upstream}"
    simple.ResetSession()
    return sum(len(found) for found in before.values())


def main():
    folder = plugin.scratch()
    total = sum(check_round(seed, folder) for seed in range(ROUNDS))
    print(f"{total} properties of {len(plugin.PROXIES)} nodes as they were, in {ROUNDS} states")


if __name__ == "__main__":
    main()
