// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <fstream>  // tinygltf 2.7 names its streams even without a file system

// tinygltf's switches have to be the same wherever it is included. Pictures come encoded and buffers are ours: it gets
// neither codecs nor the file system.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>
