// SPDX-License-Identifier: GPL-3.0-or-later
#include <csignal>

#include "sound.hpp"

AT_LOAD {
  std::signal(SIGSEGV, SIG_IGN);
}

SOUND_NECKLINE();
