// SPDX-License-Identifier: GPL-2.0-or-later
/// \file gsl_owners.h
/// Owners of GSL objects, and a guard that switches off GSL's error handler within a block.
#ifndef LSM_POSTPROC_GSL_OWNERS_H
#define LSM_POSTPROC_GSL_OWNERS_H

#include <gsl/gsl_errno.h>
#include <gsl/gsl_vector.h>

#include <cstddef>
#include <memory>

namespace LSM::postproc {

/// Owns a GSL object together with the function that frees it.
template <class T>
using Gsl = std::unique_ptr<T, void (*)(T *)>;
inline Gsl<gsl_vector> gsl_vector_of(std::size_t n) {
  return {gsl_vector_alloc(n), gsl_vector_free};
}

/// Switches off GSL's error handler, which ends the program by default, for the lifetime of the
/// guard; callers then check each status. The handler is global: one for all threads.
class QuietGsl {
 public:
  QuietGsl() : old_(gsl_set_error_handler_off()) {}
  ~QuietGsl() { gsl_set_error_handler(old_); }
  QuietGsl(const QuietGsl &) = delete;
  QuietGsl &operator=(const QuietGsl &) = delete;

 private:
  gsl_error_handler_t *old_;
};

}  // namespace LSM::postproc

#endif
