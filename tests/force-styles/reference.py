#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the data files and the yaml files of LAMMPS' testers, without LAMMPS and without the package.

The reference values of LAMMPS' testers come from this program: an independent implementation of the laws in the pages of
lammps-pkg/doc, over all pairs, with sums that are rounded once (math.fsum). README.md says how epsilon is found.

usage: reference.py FOLDER
"""
import itertools
import math
import os
import random
import sys

ROUNDING = 2.0**-53
SEEDS = (1, 1, 6)  # of the three scenes; chosen so that no component that is compared is close to 0
NEAR = 1.05  # pairs closer than this, in sums of radii, are known before they touch (onset located)


class Scene:
    """Jittered grid of discs (triangular) or spheres (cubic) in a periodic box around the origin."""

    def __init__(self, dim, seed, atom_types, bond_types, angle_types=0, speed=0.4):
        rng = random.Random(seed)
        self.dim, self.atom_types, self.bond_types, self.angle_types = dim, atom_types, bond_types, angle_types
        if dim == 2:
            counts, rise = (8, 8, 1), 0.866
            self.box = (8.0, 8 * rise, 1.0)
        else:
            counts, rise = (4, 4, 4), 1.0
            self.box = (4.0, 4.0, 4.0)
        self.x, self.v, self.radius, self.density, self.type = [], [], [], [], []
        for kz, ky, kx in itertools.product(*(range(n) for n in reversed(counts))):
            site = [kx + 0.25 + (0.5 * (ky % 2) if dim == 2 else 0.25), (ky + 0.5) * rise, kz + 0.5]
            x = [round(s - 0.5 * b + rng.uniform(-0.09, 0.09), 6) for s, b in zip(site, self.box)]
            v = [round(rng.uniform(-speed, speed), 6) for _ in range(3)]
            if dim == 2:
                x[2] = v[2] = 0.0
            self.x.append(x)
            self.v.append(v)
            self.radius.append(0.5 * round(rng.uniform(0.86, 1.16), 6))
            self.density.append(round(rng.uniform(2.0, 4.0), 6))
            self.type.append(1 if x[1] < 0.0 else 2)
        self.mass = [4.0 * math.pi / 3.0 * r**3 * d for r, d in zip(self.radius, self.density)]
        self.bonds = {}
        for i, j in itertools.combinations(range(len(self.x)), 2):
            if self.type[i] == self.type[j] and self.distance(self.x, i, j)[1] < 1.25 and rng.random() < 0.6:
                self.bonds[i, j] = 1 + rng.randrange(3)

    def distance(self, x, i, j):
        """Vector from j to i, of the nearest image, and its length."""
        d = [a - b for a, b in zip(x[i], x[j])]
        d = [c - b * round(c / b) for c, b in zip(d, self.box)]
        return d, math.sqrt(math.fsum(c * c for c in d))

    def write(self, path):
        with open(path, "w") as out:
            out.write("LAMMPS data file written by reference.py\n\n")
            out.write(f"{len(self.x)} atoms\n{self.atom_types} atom types\n{len(self.bonds)} bonds\n{self.bond_types} bond types\n")
            if self.angle_types:
                out.write(f"{self.angle_types} angle types\n")
            for b, name in zip(self.box, "xyz"):
                out.write(f"{-0.5 * b!r} {0.5 * b!r} {name}lo {name}hi\n")
            out.write("\nAtoms # hybrid\n\n")
            for n, x in enumerate(self.x):
                # molecules 1 and 3: the groups solute and solvent of the tester of fixes
                words = [n + 1, self.type[n], *x, 2 * self.type[n] - 1, 2 * self.radius[n], self.density[n]]
                out.write(" ".join(map(repr, words)) + "\n")
            out.write("\nVelocities\n\n")
            for n, v in enumerate(self.v):
                out.write(" ".join(map(repr, [n + 1, *v, 0.0, 0.0, 0.0])) + "\n")
            out.write("\nBonds\n\n")
            for n, ((i, j), kind) in enumerate(self.bonds.items()):
                out.write(f"{n + 1} {kind} {i + 1} {j + 1}\n")


class Forces:
    """Energy, virial (xx yy zz xy xz yz) and forces of one kind of interaction, as terms to be summed."""

    def __init__(self, count):
        self.energies, self.virials = [], [[] for _ in range(6)]
        self.terms = [[[], [], []] for _ in range(count)]
        self.stiffness = [0.0] * count  # sum over all that acts on a particle

    def add(self, i, j, d, force, energy, stiffness):
        """Adds a force, which acts on i. d: vector from j to i"""
        self.energies.append(energy)
        for values, (a, b) in zip(self.virials, ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))):
            values.append(d[a] * force[b])
        for c in range(3):
            self.terms[i][c].append(force[c])
            self.terms[j][c].append(-force[c])
        self.stiffness[i] += stiffness
        self.stiffness[j] += stiffness

    energy = property(lambda self: math.fsum(self.energies))
    virial = property(lambda self: [math.fsum(v) for v in self.virials])

    @staticmethod
    def total(*kinds):
        count = len(kinds[0].terms)
        return [[math.fsum(itertools.chain(*(k.terms[i][c] for k in kinds))) for c in range(3)] for i in range(count)]


def dot(a, b):
    return math.fsum(p * q for p, q in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(v):
    length = math.sqrt(dot(v, v))
    return [c / length for c in v]


def turned(v, a, b):
    """v after the rotation by the shortest way from the unit vector a to b, by Rodrigues' formula."""
    w = cross(a, b)
    once = cross(w, v)
    return [p + q + r / (1.0 + dot(a, b)) for p, q, r in zip(v, once, cross(w, once))]


class Model:
    """State of a run: positions, velocities, links that hold, contacts with friction."""

    def __init__(self, scene, links, pairs):
        """links: by bond type ('lsm', k, ratio or None) or ('harmonic', K, r0); pairs: by atom types None (off) or a dict of k, and with
        friction kt, mu, mu_static and located"""
        self.scene, self.links, self.pairs = scene, links, pairs
        self.x, self.v = [list(x) for x in scene.x], [list(v) for v in scene.v]
        self.bonds = dict(scene.bonds)
        self.contacts = {}  # pair: (elongation, vector from j to i, whether it slides, or "near")
        self.work = 0.0  # taken by the viscosity
        self.seen = set()  # what has happened, so that a scene that tests little is noticed
        self.linked = set(self.bonds)
        self.evaluate(first=True)

    def evaluate(self, first=False):
        scene = self.scene
        self.bond, self.pair = Forces(len(self.x)), Forces(len(self.x))
        for (i, j), kind in list(self.bonds.items()):
            d, r = scene.distance(self.x, i, j)
            style, k, other = self.links[kind]
            if style == "harmonic":
                k, r0 = 2.0 * k, other
            else:
                r0 = scene.radius[i] + scene.radius[j]
                if other and r > other * r0:
                    del self.bonds[i, j]
                    self.linked.discard((i, j))
                    self.seen.add("break")
                    continue
            self.bond.add(i, j, d, [-k * (r - r0) * c / r for c in d], 0.5 * k * (r - r0)**2, k)
            self.seen.add("pull" if r > r0 else "push")
        for i, j in itertools.combinations(range(len(self.x)), 2):
            if (i, j) in self.linked:
                continue
            d, r = scene.distance(self.x, i, j)
            r0 = scene.radius[i] + scene.radius[j]
            law = self.pairs[min(scene.type[i], scene.type[j]), max(scene.type[i], scene.type[j])]
            if law is None or r > NEAR * r0:
                self.contacts.pop((i, j), None)
                continue
            k = law["k"]
            normal = max(k * (r0 - r), 0.0)
            energy, kt, xi = 0.0, 0.0, [0.0, 0.0, 0.0]
            if "kt" in law:
                xi, kt = self.friction(i, j, d, r, r0, law, normal, first), law["kt"]
                energy = 0.5 * kt * dot(xi, xi)
            if r < r0:
                self.pair.add(i, j, d, [normal * c / r - kt * e for c, e in zip(d, xi)], 0.5 * k * (r0 - r)**2 + energy, k + kt)
                self.seen.add("contact")
        self.force = Forces.total(self.bond, self.pair)

    def friction(self, i, j, d, r, r0, law, normal, first):
        """Updates the tangential spring of a pair. Returns its elongation."""
        before = self.contacts.get((i, j))
        if r >= r0:
            # The pair separates or approaches: from now on its vector is known.
            self.contacts[i, j] = ([0.0, 0.0, 0.0], d, "near")
            return [0.0, 0.0, 0.0]
        xi, slides = [0.0, 0.0, 0.0], False
        if before and not first:
            xi, old, slides = before
            # The elongation grows by the displacement across the normal in the middle of the step; both turn with the normal.
            n, middle = unit(d), unit([a + b for a, b in zip(d, old)])
            moved = [a - b for a, b in zip(d, old)]
            along = dot(moved, middle)
            share = 1.0
            if slides == "near":
                was = math.sqrt(dot(old, old))
                share = (r0 - r) / (was - r) if law["located"] else 0.0
                slides = False
                self.seen.add("begin")
            moved = turned([share * (a - along * m) for a, m in zip(moved, middle)], middle, n)
            xi = [a + b for a, b in zip(turned(xi, unit(old), n), moved)]
            trial = math.sqrt(dot(xi, xi))
            slides = law["kt"] * trial > law["mu" if slides else "mu_static"] * normal
            if slides:
                xi = [law["mu"] * normal / law["kt"] / trial * c for c in xi]
            self.seen.add("slide" if slides else "stick")
        self.contacts[i, j] = (xi, d, slides)
        return xi

    def step(self, dt, viscosity=None, moving=None):
        """A step of velocity Verlet. viscosity: by atom type; velocities decay exactly for half a step before and after it."""
        scene = self.scene
        who = [n for n in range(len(self.x)) if moving is None or scene.type[n] in moving]

        def decay():
            for n in who if viscosity else ():
                factor = math.exp(-0.5 * viscosity[scene.type[n]] * dt)
                self.work += 0.5 * scene.mass[n] * (1.0 - factor**2) * math.fsum(c * c for c in self.v[n])
                self.v[n] = [factor * c for c in self.v[n]]

        def kick():
            for n in who:
                self.v[n] = [v + 0.5 * dt / scene.mass[n] * f for v, f in zip(self.v[n], self.force[n])]

        decay()
        kick()
        for n in who:
            self.x[n] = [x + dt * v for x, v in zip(self.x[n], self.v[n])]
        self.evaluate()
        kick()
        decay()


def lines(values):
    return "".join(f"\n  {n + 1:3} " + " ".join(f"{c:23.16e}" for c in v) for n, v in enumerate(values))


def block(text):
    return '""' if not text else "|" + "".join("\n  " + line for line in text.strip().split("\n"))


def write_yaml(path, header, tail):
    with open(path, "w") as out:
        out.write("---\n# written by reference.py, from which all numbers come: see README.md\n")
        for key, value in header + tail:
            out.write(f"{key}: {value}\n")
        out.write("...\n")


def head(epsilon, skip, styles, pre, post, count):
    return [("lammps_version", "4 Feb 2025"), ("tags", "lsm"), ("date_generated", "by reference.py"), ("epsilon", f"{epsilon:.0e}"),
            ("skip_tests", skip), ("prerequisites", block("atom hybrid\natom sphere\n" + styles)), ("pre_commands", block(pre)),
            ("post_commands", block(post)), ("input_file", "in.discs")], [("natoms", count)]


def bound(model, kinds, values):
    """Largest relative error of a component that rounding explains: see README.md."""
    reach = 0.5 * max(model.scene.box)
    worst = 0.0
    for n, v in enumerate(values):
        stiffness = sum(k.stiffness[n] for k in kinds)
        for c in v[:model.scene.dim]:
            if stiffness:
                worst = max(worst, 3.0 * ROUNDING * reach * stiffness / abs(c))
    return worst


def force_test(folder, kind, name, scene, dim, links, pairs, styles, expected, pre="", post=""):
    """yaml file of test_bond_style or test_pair_style: forces, energy and virial at once, and after 4 steps of 0.05"""
    model = Model(scene, links, pairs)
    results = []
    epsilon = 0.0
    for _ in range(2):
        tested = model.bond if kind == "bond" else model.pair
        results.append((tested.energy, tested.virial, model.force))
        epsilon = max(epsilon, bound(model, (model.bond, model.pair), model.force))
        if not epsilon < 1e-10:
            raise SystemExit(f"{name}: a force that almost cancels makes epsilon {epsilon:g}; choose another seed")
        if len(results) == 1:
            for _ in range(4):
                model.step(0.05)
    if not expected <= model.seen:
        raise SystemExit(f"{name}: nothing in the scene did: {expected - model.seen}")
    coefficients, style, extract = styles
    pre = f"variable dim index {dim}\n" + pre
    top, tail = head(epsilon, "single", f"{kind} {style.split()[0]}", pre, post, len(scene.x))
    middle = [(f"{kind}_style", style), (f"{kind}_coeff", block(coefficients))]
    if kind == "bond":
        widest = 2.0 * max(scene.radius)
        middle.append(("equilibrium", f"{scene.bond_types}" + f" {widest!r}" * scene.bond_types))
    middle.append(("extract", block(extract)))
    for when, (energy, virial, force) in zip(("init", "run"), results):
        if kind == "bond":
            tail.append((f"{when}_energy", repr(energy)))
        else:
            tail += [(f"{when}_vdwl", repr(energy)), (f"{when}_coul", "0")]
        tail.append((f"{when}_stress", "|-\n  " + " ".join(f"{v:23.16e}" for v in virial)))
        tail.append((f"{when}_forces", "|2" + lines(force)))
    write_yaml(os.path.join(folder, f"{kind}-{name}.yaml"), top + middle, tail)
    return epsilon


def fix_test(folder, name, scene, links, pairs, options, moving, viscosity, post, expected):
    """yaml file of test_fix_timestep: positions and velocities after 8 steps of 0.25"""
    model = Model(scene, links, pairs)
    for _ in range(8):
        model.step(0.25, viscosity, moving)
    if not expected <= model.seen:
        raise SystemExit(f"{name}: nothing in the scene did: {expected - model.seen}")
    # Rounding errors of positions in each step, and the resulting errors of velocities, do not grow
    # much in 8 steps.
    reach = 0.5 * max(scene.box)
    epsilon = max(8.0 * ROUNDING * reach / abs(c) for values in (model.x, model.v) for v in values for c in v[:2])
    if not epsilon < 1e-10:
        raise SystemExit(f"{name}: a component near 0 makes epsilon {epsilon:g}; choose another seed")
    post = post + f"\nfix test {options}\nrun_style verlet"
    top, tail = head(epsilon, "", f"fix {options.split()[1]}\npair lsm/friction\nbond lsm/linked",
                     "variable dim index 2\nvariable links index molecular", post, len(scene.x))
    tail += [("global_scalar", repr(model.work)), ("global_vector", "|-\n  2 0 0")]
    tail += [("run_pos", "|2" + lines(model.x)), ("run_vel", "|2" + lines(model.v)), ("run_torque", "|2" + lines([[0.0] * 3] * len(model.x)))]
    write_yaml(os.path.join(folder, f"fix-{name}.yaml"), top, tail)
    return epsilon


def main():
    folder = sys.argv[1]
    scenes = {2: Scene(2, SEEDS[0], 2, 3), 3: Scene(3, SEEDS[1], 2, 3)}
    for dim, scene in scenes.items():
        scene.write(os.path.join(folder, f"data.bond_{dim}d"))
    blocks = Scene(2, SEEDS[2], 5, 5, 4, speed=0.1)
    blocks.write(os.path.join(folder, "data.molecular_2d"))

    plain = {1: ("lsm", 1.0, None), 2: ("lsm", 0.7, None), 3: ("lsm", 1.4, None)}
    plain_text = "1 1.0\n2 0.7\n3 1.4"
    breakable = {1: ("lsm", 1.0, None), 2: ("lsm", 0.7, 1.06), 3: ("lsm", 1.4, 1.02)}
    breakable_text = "1 1.0\n2 0.7 1.06\n3 1.4 1.02"
    hybrid = {1: ("lsm", 1.0, None), 2: ("harmonic", 0.35, 1.01), 3: ("lsm", 1.4, 1.02)}
    hybrid_text = "1 lsm/linked 1.0\n2 harmonic 0.35 1.01\n3 lsm/linked 1.4 1.02"
    free = {(1, 1): {"k": 1.3}, (1, 2): {"k": 0.9}, (2, 2): {"k": 1.1}}
    free_text = "1 1 1.3\n1 2 0.9\n2 2 1.1"
    half = {**free, (2, 2): None}
    half_text = "1 1 1.3\n1 2 0.9\n2 2 off"

    def pair_post(text):
        return "".join(f"pair_coeff {line}\n" for line in text.split("\n"))

    def bond_post(text):
        return "".join(f"bond_coeff {line}\n" for line in text.split("\n"))

    done = {}
    both = {"pull", "push", "contact"}
    for dim in (2, 3):
        done[f"bond-lsm_linked_{dim}d"] = force_test(folder, "bond", f"lsm_linked_{dim}d", scenes[dim], dim, plain, free,
                                                     (plain_text, "lsm/linked", "k 1"), both, post=pair_post(free_text))
        done[f"bond-lsm_linked_breakable_{dim}d"] = force_test(folder, "bond", f"lsm_linked_breakable_{dim}d", scenes[dim], dim, breakable, free,
                                                               (breakable_text, "lsm/linked", "k 1"), both | {"break"}, post=pair_post(free_text))
        done[f"pair-lsm_free_{dim}d"] = force_test(folder, "pair", f"lsm_free_{dim}d", scenes[dim], dim, plain, free if dim == 2 else half,
                                                   (free_text if dim == 2 else half_text, "lsm/free", "k 2\non 1"), both, post=bond_post(plain_text))
    done["bond-hybrid_lsm_linked"] = force_test(folder, "bond", "hybrid_lsm_linked", scenes[2], 2, hybrid, free,
                                                (hybrid_text, "hybrid lsm/linked harmonic", ""), both | {"break"}, post=pair_post(free_text))
    for name, onset, static, dim in (("lsm_friction", "located", 0.6, 2), ("lsm_friction_step", "step", 0.6, 2),
                                     ("lsm_friction_static", "located", 0.9, 2), ("lsm_friction_3d", "located", 0.6, 3), ("lsm_friction_static_3d",
                                                                                                                          "located", 0.9, 3)):
        law = {
            pair: {"located": onset == "located", "k": k, "kt": kt, "mu": mu, "mu_static": max(mu, held)}
            for pair, k, kt, mu, held in (((1, 1), 1.3, 0.8, 0.6, static), ((1, 2), 0.9, 1.0, 0.6, static), ((2, 2), 1.1, 1.2, 0.3, 0.3))
        }
        text = "\n".join(f"{i} {j} {c['k']} {c['kt']} {c['mu']}" + (f" {c['mu_static']}" if c["mu_static"] > c["mu"] else "")
                         for (i, j), c in law.items())
        done[f"pair-{name}"] = force_test(folder, "pair", name, scenes[dim], dim, plain, law,
                                          (text, f"lsm/friction onset {onset}", "k 2\non 1\nkt 2\nmu 2"), both | {"stick", "slide", "begin"},
                                          post=bond_post(plain_text))
    law = {pair: {"located": True, "k": 1.0, "kt": 0.8, "mu": 0.6, "mu_static": 0.6} for pair in ((1, 1), (1, 2), (2, 2))}
    soft = {kind: ("lsm", 0.5, None) for kind in (1, 2, 3)}
    what = both | {"stick", "slide", "begin"}

    styles = ("pair_style lsm/friction\npair_coeff * * 1.0 0.8 0.6\nbond_style lsm/linked\nbond_coeff * 0.5\n"
              "angle_style none\ncompute events all lsm/events ledger yes")

    done["fix-lsm_nve"] = fix_test(folder, "lsm_nve", blocks, soft, law, "solute lsm/nve dtcheck off", (1,), None, styles, what)
    done["fix-lsm_nve_viscosity"] = fix_test(folder, "lsm_nve_viscosity", blocks, soft, law,
                                             "all lsm/nve viscosity 0.05 viscosity/type 2 0.3 dtcheck off", None, {1: 0.05, 2: 0.3}, styles, what)
    for name, epsilon in done.items():
        print(f"{name:32} epsilon {epsilon:.0e}")


if __name__ == "__main__":
    main()
