# SPDX-License-Identifier: BSD-3-Clause
"""Virtual restoration ([HT] 6.2): a cavity of a scan is filled with implicit primitives.

    xvfb-run -a pvpython examples/python/restoration.py [output folder]
"""
