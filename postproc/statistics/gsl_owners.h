// SPDX-License-Identifier: GPL-2.0-or-later
/// \file gsl_owners.h
/// Owners of GSL objects.
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

/// GSL's error handler, which would end the program, is off from the start: callers check each
/// status. (It is global, so that threads must not switch it.)
inline gsl_error_handler_t *const usual_handler = gsl_set_error_handler_off();

}  // namespace LSM::postproc

#endif
