// SPDX-License-Identifier: GPL-3.0-or-later
// The item alone, for a frame in another page: the 3D view starts when it is asked for.
import './item.js';
