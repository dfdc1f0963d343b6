// SPDX-License-Identifier: GPL-3.0-or-later
#define TINYGLTF_IMPLEMENTATION
#include "gltf.hpp"
