// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// From now on the GUI places new sources at what is to be seen. Their defaults are about 1 in size
/// and lie around 0: right where a model is begun, but lost beside a scan of hundreds of
/// millimetres. There a source starts on top of what is visible, an eighth of its size, in round
/// numbers.
///
/// Only what the user makes by the menus: a script, a state, a trace or undo finds the values that
/// its author had. Does nothing without a GUI.
void placeNewSources();
