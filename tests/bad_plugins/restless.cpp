// SPDX-License-Identifier: GPL-3.0-or-later
#include <pthread.h>
#include <unistd.h>

#define vitrine_plugin_entry declared_constant
#include "sound.hpp"
#undef vitrine_plugin_entry

namespace {

char title[] = "Skirt 0";
vitrine_garment garments[1] = {sound::garments[0]};

void* change_later(void*) {
  usleep(100'000);
  title[6] = '1';
  return nullptr;
}

}  // namespace

extern "C" {
VITRINE_EXPORT vitrine_plugin vitrine_plugin_entry = sound::entry;
}

// A table that is another one a tenth of a second after it was read.
AT_LOAD {
  garments[0].title = title;
  vitrine_plugin_entry.garments.data = garments;
  pthread_t thread;
  pthread_create(&thread, nullptr, change_later, nullptr);
}
