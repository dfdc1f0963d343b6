/* SPDX-License-Identifier: GPL-3.0-or-later
 * Preloaded into the real program by catalog_faults_test: what a worker meets depends on the photo that it opens, and
 * on the folder that it writes to. The process that the library was loaded into, the run itself, is left alone but for
 * a full disk. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

static pid_t run;

__attribute__((constructor)) static void loaded(void) {
  run = getpid();
}

static void meet(const char* path) {
  if (path == NULL || getpid() == run) return;
  const char* name = strrchr(path, '/');
  name = name == NULL ? path : name + 1;
  if (strncmp(name, "crash", 5) == 0) abort();
  if (strncmp(name, "hang", 4) == 0)
    for (;;) pause();
  if (strncmp(name, "spin", 4) == 0)
    for (volatile unsigned long i = 0;; ++i) {
    }
  if (strncmp(name, "eat", 3) == 0)
    /* Address space is what is limited. Were the pages written to, a slow machine would first be out of time. */
    for (;;) {
      volatile char* much = malloc(64u << 20);
      if (much == NULL) _exit(3); /* what a library does that cannot go on */
      *much = 1;
    }
  if (strncmp(name, "gone", 4) == 0) unlink(path);
}

#define OPEN(name)                                                            \
  int name(const char* path, int flags, ...) {                                \
    static int (*real)(const char*, int, ...);                                \
    if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, #name);               \
    va_list more;                                                             \
    va_start(more, flags);                                                    \
    mode_t mode = (flags & (O_CREAT | O_TMPFILE)) ? va_arg(more, mode_t) : 0; \
    va_end(more);                                                             \
    meet(path);                                                               \
    return real(path, flags, mode);                                           \
  }
OPEN(open)
OPEN(open64)

#define FOPEN(name)                                             \
  FILE* name(const char* path, const char* mode) {              \
    static FILE* (*real)(const char*, const char*);             \
    if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, #name); \
    meet(path);                                                 \
    return real(path, mode);                                    \
  }
FOPEN(fopen)
FOPEN(fopen64)

/* The disk is full for files in a folder "full"; only half of what is written arrives before that is noticed. */
ssize_t write(int fd, const void* data, size_t size) {
  static ssize_t (*real)(int, const void*, size_t);
  if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, "write");
  char link[64], path[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t n = readlink(link, path, sizeof path - 1);
  if (n > 0) {
    path[n] = 0;
    if (strstr(path, "/full-") != NULL && strstr(path, ".glb") != NULL) {
      if (size > 1 && strstr(path, "garment") != NULL) return real(fd, data, size / 2) < 0 ? -1 : (errno = ENOSPC, -1);
      errno = ENOSPC;
      return -1;
    }
  }
  return real(fd, data, size);
}
