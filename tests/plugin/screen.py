# SPDX-License-Identifier: BSD-3-Clause
"""The ParaView GUI on a screen of its own, with no settings of the user's."""
import os
import signal
import subprocess


def run_paraview(xvfb_run, arguments, home, **variables):
    """Returns what it printed; ends it, and its screen, if it takes too long."""
    environment = dict(os.environ, HOME=home, XDG_CONFIG_HOME=home, XDG_RUNTIME_DIR=home, **variables)
    environment["DASHBOARD_TEST_FROM_CTEST"] = "1"  # ParaView's own tests: ask nobody for confirmation
    command = [xvfb_run, "-a", "-s", "-screen 0 1280x1024x24 -noreset", "paraview", "--dr", *arguments]
    process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        text=True, start_new_session=True)
    try:
        output, _ = process.communicate(timeout=240)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        output, _ = process.communicate()
        raise RuntimeError("paraview did not come to an end:\n" + output) from None
    assert process.returncode == 0, output
    return output
