// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_stiffness.h
/// Static stiffness of the coupling between blocks † (the paper has springs between neighbours):
/// the force on a block per slip, for slip that varies along the fault as cos q x, x in blocks.
///
/// The fault lies between two elastic blocks of thickness W, each held by a plate at its far side,
/// so that each edge moves by half of the slip. With mu' = G / 2, half of their shear modulus, and
/// slip u cos q x, the force per block is K(q) u:
///   antiplane  K = mu' q coth q W, by Laplace's equation;
///   in plane   K = mu' q / (1 - nu) (k cosh 2a + 2 a^2 + 5 - 12 nu + 8 nu^2) / (k sinh 2a + 2 a),
///              a = q W, k = 3 - 4 nu, plane strain, no change of the normal stress, by symmetry;
///              the edge of a layer on a rigid base (Bentall and Johnson 1968, Int. J. Mech. Sci.
///              10, 637), which a test computes independently from Navier's equations.
/// Both are mu' / W at q = 0, the leaf spring K_l: uniform slip shears the blocks over W. For q W
/// >> 1 they are mu' q and mu' q / (1 - nu), those of half-spaces (Geubelle and Rice 1995, J. Mech.
/// Phys. Solids 43, 1791).
#ifndef SLIDER_STIFFNESS_H
#define SLIDER_STIFFNESS_H

#include <string>
#include <vector>

#include "slider_parameters.h"

namespace Slider {

/// What couples the blocks.
enum class Coupling { chain, antiplane, inplane };
constexpr std::array<LSM::Named<Coupling>, 3> names_of(Coupling) {
  return {{{Coupling::chain, "chain"},
           {Coupling::antiplane, "antiplane"},
           {Coupling::inplane, "inplane"}}};
}

/// Poisson's ratio in plane: equal Lame constants, as in a lattice with forces along its links.
constexpr double poisson = 0.25;

/// K(q) / mu' of the two blocks, antiplane or in plane.
/// \param q at least 0
/// \param width W, in blocks
double strip_stiffness(Coupling coupling, double q, double width);

/// Elastic blocks on both sides of the fault, which replace the springs K_c: a block that slips
/// alone in a long fault feels the same stiffness as with springs, 2 K_c + K_l.
struct Strip {
  double modulus = 0.0;  ///< mu'
  double width = 0.0;    ///< W
};
/// Returns the blocks for which mu' / W is the given leaf spring K_l.
/// \throws std::invalid_argument if there are none
Strip strip_of_leaf_spring(Coupling coupling, double kc, double kl);
/// Returns the blocks of thickness W.
Strip strip_of_width(Coupling coupling, double kc, double width);

/// Stiffness of the modes 0 to blocks / 2 of a periodic fault, whose wavenumbers are
/// 2 pi mode / blocks.
std::vector<double> modes_of(Coupling coupling, const Strip &strip, int blocks);

/// Reads the stiffness of these modes from a file of lines "wavenumber,stiffness" (radians per
/// block; force per slip) in ascending order, from 0 (the leaf spring) to pi or beyond. It is
/// interpolated linearly between the lines; '#' begins a comment.
/// \throws LSM::FileError naming file and line
std::vector<double> read_modes(const std::string &path, int blocks);

/// Returns the name of a file and the CRC-32 of its content, which identify it in headers.
/// \throws LSM::FileError
std::string named_with_checksum(const std::string &path);

}  // namespace Slider

#endif
