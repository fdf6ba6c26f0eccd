// SPDX-License-Identifier: GPL-2.0-or-later
/// \file standard_streams.h
/// Standard streams that a program was started without, shared by the programs.
#ifndef LSM_CLI_STANDARD_STREAMS_H
#define LSM_CLI_STANDARD_STREAMS_H

#include <fcntl.h>
#include <unistd.h>

namespace LSM {

/// Opens closed standard streams; to be called before anything else. If a program is started with
/// closed standard streams, as some daemons do, the files that it opens get their numbers, and its
/// messages are written into these files. After this call, writing to such a standard output fails
/// instead, and messages are lost.
inline void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0)
      // The lowest free number is this one, as all below it are taken.
      static_cast<void>(open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY));
}

}  // namespace LSM

#endif
