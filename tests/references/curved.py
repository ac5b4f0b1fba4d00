#!/usr/bin/python3
"""Finite-element references of curved, bonded and clamped bodies (CalculiX, C3D20R 20-node bricks, linear statics).

    apt-get install -y calculix-ccx python3-numpy
    /usr/bin/python3 curved.py [--work /tmp/curved_ref] [--only CASE] [--sizes N]

Writes curved.json beside itself. Structured meshes, numbered here; no mesh generator. E = 1000 and no units, except for the
bracket (mm, N, MPa). Curved edges have their mid nodes on the exact surface.
"""
import argparse, json, math, os, subprocess, time
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
PI = math.pi

# ---------------------------------------------------------------- mesh
CORNERS = np.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)])
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
BRICK = np.vstack([CORNERS, [(CORNERS[a] + CORNERS[b]) // 2 for a, b in EDGES]])       # ccx order on a 3 x 3 x 3 lattice

def even(a, b, n): return a + (b - a) * np.arange(n + 1) / n

def graded(a, b, n, low, high, p=2.0):
    """n intervals from a to b, shrinking with power p towards the ends asked for; one smooth map for all n."""
    t = np.arange(n + 1) / n
    if low and high: t = np.where(t < 0.5, (2 * t) ** p / 2, 1 - (2 - 2 * t) ** p / 2)
    elif low: t = t ** p
    elif high: t = 1 - (1 - t) ** p
    return a + (b - a) * t

class Mesh:
    """Bricks over the product of three lists of corner coordinates; keep(i, j, k) picks elements, place(p) maps nodes."""
    def __init__(self, axes, place=lambda p: p, keep=None):
        n = self.n = [len(a) - 1 for a in axes]
        fine = [np.interp(np.arange(2 * m + 1) / 2, np.arange(m + 1), a) for m, a in zip(n, axes)]
        dims = [2 * m + 1 for m in n]
        ijk = np.stack(np.meshgrid(*map(np.arange, n), indexing='ij'), -1).reshape(-1, 3)
        if keep is not None: ijk = ijk[keep(*ijk.T)]
        lat = np.ravel_multi_index(np.moveaxis(2 * ijk[:, None] + BRICK, -1, 0), dims)
        used, inv = np.unique(lat, return_inverse=True)
        self.ijk, self.elem = ijk, inv.reshape(-1, 20)
        self.par = np.stack([f[i] for f, i in zip(fine, np.unravel_index(used, dims))], -1)
        self.x = place(self.par)

    def face(self, axis, high):
        """Quadratic quadrilaterals (4 corners, 4 mid nodes) of the elements at one end of the lattice."""
        e = self.elem[self.ijk[:, axis] == (self.n[axis] - 1 if high else 0)]
        on = [m for m in range(20) if BRICK[m, axis] == (2 if high else 0)]
        u, v = [a for a in range(3) if a != axis]
        where = {(BRICK[m, u], BRICK[m, v]): m for m in on}
        return e[:, [where[q] for q in ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))]]

    def faces(self, ends): return np.concatenate([self.face(*end) for end in ends])

    def node(self, p):
        d = np.linalg.norm(self.x - p, axis=1); i = int(d.argmin())
        assert d[i] < 1e-9, 'no node at the point'
        return i

def quad8(r, s):
    """Shape functions of the 8-node quadrilateral and their derivatives."""
    c = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]); N, R, S = np.zeros(8), np.zeros(8), np.zeros(8)
    for i, (a, b) in enumerate(c):
        N[i] = (1 + a * r) * (1 + b * s) * (a * r + b * s - 1) / 4
        R[i] = a * (1 + b * s) * (2 * a * r + b * s) / 4
        S[i] = b * (1 + a * r) * (2 * b * s + a * r) / 4
    for i, b in ((4, -1), (6, 1)): N[i], R[i], S[i] = (1 - r * r) * (1 + b * s) / 2, -r * (1 + b * s), b * (1 - r * r) / 2
    for i, a in ((5, 1), (7, -1)): N[i], R[i], S[i] = (1 - s * s) * (1 + a * r) / 2, a * (1 - s * s) / 2, -s * (1 + a * r)
    return N, R, S

def weights(M, face):
    """Integral of each node's shape function over the face: consistent loads of a unit traction, and the area."""
    w = np.zeros(len(M.x)); X = M.x[face]; g = math.sqrt(0.6)
    for r, a in ((-g, 5 / 9), (0, 8 / 9), (g, 5 / 9)):
        for s, b in ((-g, 5 / 9), (0, 8 / 9), (g, 5 / 9)):
            N, R, S = quad8(r, s)
            J = np.linalg.norm(np.cross(np.einsum('i,eid->ed', R, X), np.einsum('i,eid->ed', S, X)), axis=1)
            np.add.at(w, face, a * b * J[:, None] * N)
    return w, w.sum()

# ---------------------------------------------------------------- CalculiX
def solve(M, E, nu, held, force, shown, work, name):
    """held: (nodes, direction, value); force: nodes x 3. Displacements of the nodes shown (others nan) and reactions held.
    Numbers are written in at most 20 characters: ccx cuts longer ones."""
    fixed = np.unique(np.concatenate([h[0] for h in held]))
    with open(os.path.join(work, name + '.inp'), 'w') as f:
        f.write('*NODE, NSET=NALL\n')
        for i, p in enumerate(M.x): f.write('%d,%.12g,%.12g,%.12g\n' % (i + 1, *p))
        f.write('*ELEMENT, TYPE=C3D20R, ELSET=EALL\n')
        for i, e in enumerate(M.elem + 1):
            f.write('%d,' % (i + 1) + ','.join(map(str, e[:10])) + ',\n' + ','.join(map(str, e[10:])) + '\n')
        for s, nodes in (('HELD', fixed), ('SHOWN', shown)):
            f.write('*NSET, NSET=%s\n' % s + ''.join('%d,\n' % (i + 1) for i in nodes))
        f.write('*MATERIAL, NAME=MAT\n*ELASTIC\n%.12g,%.12g\n*SOLID SECTION, ELSET=EALL, MATERIAL=MAT\n' % (E, nu))
        f.write('*STEP\n*STATIC\n*BOUNDARY\n')
        for nodes, d, v in held:
            for i in nodes: f.write('%d,%d,%d,%.12g\n' % (i + 1, d + 1, d + 1, v))
        if np.any(force):
            f.write('*CLOAD\n')
            for i, d in np.argwhere(force): f.write('%d,%d,%.12e\n' % (i + 1, d + 1, force[i, d]))
        f.write('*NODE PRINT, NSET=SHOWN\nU\n*NODE PRINT, NSET=HELD\nRF\n*END STEP\n')
    t0 = time.time()
    r = subprocess.run(['ccx', '-i', name], cwd=work, capture_output=True, text=True, env=dict(os.environ, OMP_NUM_THREADS='1'))
    if r.returncode or 'Job finished' not in r.stdout or '*ERROR' in r.stdout:
        raise RuntimeError('ccx failed on %s: %s' % (name, r.stdout[-400:]))
    U, R, now = np.full(M.x.shape, np.nan), np.full(M.x.shape, np.nan), None
    for l in open(os.path.join(work, name + '.dat')):
        t = l.split()
        if l.startswith(' displacements'): now = U
        elif l.startswith(' forces'): now = R
        elif len(t) == 4 and now is not None: now[int(t[0]) - 1] = [float(a) for a in t[1:]]
    assert np.isfinite(U[shown]).all() and np.isfinite(R[fixed]).all()
    for e in ('.inp', '.dat', '.frd', '.sta', '.cvg', '.12d'):
        if os.path.exists(os.path.join(work, name + e)): os.remove(os.path.join(work, name + e))
    return U, R, time.time() - t0

r7 = lambda v: float('%.7g' % v)
r2 = lambda v: float('%.2g' % v)

def loaded(M, E, nu, clamp, load, area, force, point, also, work, name):
    """Clamp faces, spread a force over others; displacements along the force: area mean of the loaded faces, and a point."""
    face = M.faces(load); w, got = weights(M, face)
    assert abs(got / area - 1) < 1e-5, (got, area)
    force = np.array(force, float); size = np.linalg.norm(force); way = force / size
    fixed = np.unique(M.faces(clamp))
    held = [(fixed, d, 0.0) for d in range(3)] + also(M)
    nodal = w[:, None] * force / got
    U, R, s = solve(M, E, nu, held, nodal, np.unique(face), work, name)
    back = np.nansum(R[fixed] - nodal[fixed], 0) @ way     # ccx counts the load at a held node into RF
    assert abs(back / size + 1) < 1e-4, back
    out = dict(elements=len(M.elem), nodes=len(M.x), mean=r7(np.nansum(w[:, None] * U, 0) @ way / got), solve_s=round(s, 1))
    if point is not None: out['point'] = r7(U[M.node(point)] @ way)
    return out

def change(runs, key):
    """Relative change between the last two meshes."""
    return r2(runs[-1][key] / runs[-2][key] - 1) if len(runs) > 1 else None

# ---------------------------------------------------------------- half ring
RI, RO, RM, H, W = 9.75, 10.25, 10.0, 0.5, 1.0

def ring_mesh(n):
    def place(p):
        r, t, z = p.T
        return np.stack([r * np.cos(t), r * np.sin(t), z], -1)
    return Mesh([even(RI, RO, n), even(0, PI, 20 * n), even(0, W, 2 * n)], place)

def ring_theory(E, nu):
    """Curved beam clamped at 180 degrees, unit force at the free end (R, 0); t is the angle from that end.
    Along x: M = R sin t (opens the ring), N = sin t, V = cos t; Winkler energy per angle
    M^2/(2 A E e) + N^2 R/(2 A E) - M N/(A E) + V^2 R 1.2/(2 G A), e = R - H/ln(RO/RI). Integrals of sin^2, cos^2: pi/2.
    Along z: bending R sin t about the radius, torsion R (1 - cos t), shear 1."""
    G, A = E / 2 / (1 + nu), H * W
    I, e = W * H ** 3 / 12, RM - H / math.log(RO / RI)
    J = W * H ** 3 * (1 / 3 - 64 / PI ** 5 * H / W * sum(math.tanh(k * PI * W / 2 / H) / k ** 5 for k in range(1, 40, 2)))
    return dict(
        x=dict(bending_only=r7(PI * RM ** 3 / (2 * E * I)),
               winkler=r7(PI / 2 * (RM ** 2 / (A * E * e) + RM / (A * E) - 2 * RM / (A * E) + 1.2 * RM / (G * A))),
               formula='bending only: integral of (F R sin t)^2 R dt/(E I F) over 0..pi = pi F R^3/(2 E I), I = W H^3/12; winkler: '
                       'pi/2 F (R^2/(A E e) + R/(A E) - 2 R/(A E) + 1.2 R/(G A)), e = R - H/ln(RO/RI)'),
        z=dict(beam=r7(RM ** 3 * (PI / 2 / (E * H * W ** 3 / 12) + 3 * PI / 2 / (G * J)) + 1.2 * PI * RM / (G * A)),
               formula='F R^3 (pi/(2 E I) + 3 pi/(2 G J)) + 1.2 pi F R/(G A), I = H W^3/12, J of the rectangle (Saint-Venant)'))

def half_ring(a):
    E, nu = 1000.0, 0.3
    theory = ring_theory(E, nu)
    out = dict(geometry='ring sector, radii 9.75 to 10.25, z 0 to 1, angles 0 to 180 degrees in the x-y plane about the origin, 0 at +x',
               E=E, nu=nu, supports='end face at 180 degrees (y = 0, x < 0): all displacements zero', loads={})
    for label, force in (('x', (1, 0, 0)), ('z', (0, 0, 1))):
        runs = []
        for n in (2, 4, 6)[:a.sizes]:
            r = loaded(ring_mesh(n), E, nu, [(1, True)], [(1, False)], H * W, force, (RM, 0, W / 2), lambda M: [], a.work, 'ring')
            runs.append(dict(bricks='%d radial x %d around x %d along z' % (n, 20 * n, 2 * n), **r)); print('half_ring', label, runs[-1], flush=True)
        t = theory[label]; best = t.get('winkler', t.get('beam'))
        out['loads'][label] = dict(
            load='total force 1 along +%s, uniform traction over the end face at 0 degrees (y = 0, x > 0)' % label,
            value=dict(mean_displacement_loaded_face=runs[-1]['mean'], displacement_at_10_0_0p5=runs[-1]['point']),
            measured='displacement along the load', convergence=dict(mean=change(runs, 'mean'), point=change(runs, 'point')),
            theory=dict(t, value_over_theory=r7(runs[-1]['mean'] / best)), by_mesh_size=runs)
    return out

# ---------------------------------------------------------------- quarter sphere
def sphere_mesh(n):
    """Half an octahedron over the square [0, 1]^2, blown up: the edges s = 0 and t = 1 go to y = 0, t = 0 and s = 1 to z = 0.
    The diagonal s + t = 1, where the octahedron folds, runs through the corners of elements."""
    def place(p):
        r, s, t = p.T
        d = np.stack([1 - s - t, np.minimum(s, 1 - t), np.minimum(t, 1 - s)], -1)
        return r[:, None] * d / np.linalg.norm(d, axis=1)[:, None]
    return Mesh([even(RI, RO, n[0]), even(0, 1, n[1]), even(0, 1, n[1])], place)

def quarter_sphere(a):
    E, nu, runs = 1000.0, 0.3, []
    for n in ((2, 16), (2, 32), (2, 48), (2, 64))[:a.sizes]:
        clamp, load = [(2, False), (1, True)], [(1, False), (2, True)]
        r = loaded(sphere_mesh(n), E, nu, clamp, load, PI / 2 * (RO ** 2 - RI ** 2), (0, 0, 1), (0, 0, RM), lambda M: [], a.work, 'sphere')
        runs.append(dict(bricks='%d radial x %d x %d' % (n[0], n[1], n[1]), **r)); print('quarter_sphere', runs[-1], flush=True)
    return dict(
        geometry='quarter of a spherical shell about the origin, radii 9.75 to 10.25, y and z >= 0',
        E=E, nu=nu, supports='edge face z = 0: all displacements zero',
        load='total force 1 along +z, uniform traction over the edge face y = 0',
        value=dict(mean_displacement_loaded_face=runs[-1]['mean'], displacement_at_0_0_10=runs[-1]['point']),
        measured='displacement along z', convergence=dict(mean=change(runs, 'mean'), point=change(runs, 'point')), by_mesh_size=runs)

# ---------------------------------------------------------------- bonded block
def bonded_block(a):
    """One eighth: x and y in [0, 1], z in [0, 0.5]; the middle plane moves by half and stays plane."""
    E, cases = 1000.0, {}
    for nu in (0.0, 0.3, 0.45, 0.49, 0.499):
        runs = []
        for n in ((7, 5), (12, 9), (18, 14))[:a.sizes]:
            M = Mesh([graded(0, 1, n[0], False, True, 2.5)] * 2 + [graded(0, 0.5, n[1], True, False, 2.5)])
            at = lambda d, high: np.unique(M.face(d, high))
            bottom = at(2, False)
            held = [(bottom, d, 0.0) for d in range(3)] + [(np.setdiff1d(at(d, False), bottom), d, 0.0) for d in (0, 1)]
            held.append((at(2, True), 2, -0.005))
            U, R, s = solve(M, E, nu, held, np.zeros(M.x.shape), bottom, a.work, 'block')
            up, down = np.nansum(R[bottom, 2]), np.nansum(R[at(2, True), 2])
            assert abs(up / down + 1) < 1e-4, (up, down)
            runs.append(dict(bricks='%d x %d x %d in one eighth' % (n[0], n[0], n[1]), elements=len(M.elem), nodes=len(M.x),
                             modulus_over_E=r7(-down / 0.01 / E), solve_s=round(s, 1)))
            print('bonded_block', nu, runs[-1], flush=True)
        cases['%g' % nu] = dict(nu=nu, value=runs[-1]['modulus_over_E'], convergence=change(runs, 'modulus_over_E'), by_mesh_size=runs)
    return dict(
        geometry='block 2 x 2 x 1, height 1 along z; computed on one eighth by symmetry, elements shrinking towards the bonded border',
        E=E, supports='bottom face: all displacements zero', load='top face moved by -0.01 along z, no sideways motion',
        measured='apparent modulus over E: total reaction / area 4 / strain 0.01 / E', by_nu=cases)

# ---------------------------------------------------------------- bracket
def bracket(a):
    """The half z in [15, 30] of the L, symmetric about z = 15."""
    E, nu, runs = 2100.0, 0.35, []
    for n in (2, 4, 6)[:a.sizes]:
        corner = graded(0, 6, 2 * n, False, True, 2)
        x = np.concatenate([corner, graded(6, 80, 7 * n, True, False, 2)[1:]])
        y = np.concatenate([corner, graded(6, 60, 8 * n, True, True, 1.8)[1:]])
        M = Mesh([x, y, graded(15, 30, 2 * n, False, True, 1.5)], keep=lambda i, j, k: (i < 2 * n) | (j < 2 * n))
        def mid(M): s = np.unique(M.face(2, False)); return [(s, 2, 0.0)]
        r = loaded(M, E, nu, [(1, True)], [(0, True)], 90.0, (0, -25, 0), None, mid, a.work, 'bracket')
        runs.append(dict(bricks='%d through each thickness, %d along the arm, %d along the leg, %d over half the width'
                                % (2 * n, 7 * n, 8 * n, 2 * n), **r)); print('bracket', runs[-1], flush=True)
    for r in runs: r['mean'] = -r['mean']                  # along +y
    return dict(
        geometry='L: union of [0,80]x[0,6]x[0,30] and [0,6]x[0,60]x[0,30], sharp inner corner at (6,6,z); computed on half the width by symmetry',
        units='mm, N, MPa', E=E, nu=nu, supports='end face of the leg (y = 60): all displacements zero',
        load='50 N along -y, uniform traction over the end face of the arm (x = 80)',
        value=dict(mean_displacement_loaded_face=runs[-1]['mean']), measured='displacement along +y',
        convergence=dict(mean=change(runs, 'mean')), by_mesh_size=runs)

# ---------------------------------------------------------------- clamped beam
def box_weights(M):
    """Integral of each node's shape function over the volume, for rectangular bricks: -1/8 of an element at its corners,
    1/6 at its mid nodes. Consistent loads of a unit body force, and the volume."""
    w = np.zeros(len(M.x)); v = np.prod(M.x[M.elem[:, 6]] - M.x[M.elem[:, 0]], axis=1)
    np.add.at(w, M.elem, v[:, None] * np.where(np.arange(20) < 8, -1 / 8, 1 / 6))
    return w, w.sum()

def clamped_beam(a):
    """The quarter y, z in [0.05, 0.1]: symmetric about z = 0.05; about y = 0.05 the motion along y is even and the rest odd.
    The four corners of the end face then move alike along y."""
    E, volume, cases = 1000.0, 0.4 * 0.05 * 0.05, {}
    for nu in (0.3, 0.49, 0.499):
        runs = []
        for n in (4, 8, 12)[:a.sizes]:
            M = Mesh([graded(0, 0.4, 4 * n, True, False, 2.5)] + [graded(0.05, 0.1, n, False, True, 2.5)] * 2)
            at = lambda d: np.unique(M.face(d, False))
            w, got = box_weights(M)
            assert abs(got / volume - 1) < 1e-9, (got, volume)
            end, y, z = at(0), np.setdiff1d(at(1), at(0)), np.setdiff1d(at(2), at(0))
            held = [(end, d, 0.0) for d in range(3)] + [(y, 0, 0.0), (y, 2, 0.0), (np.setdiff1d(z, y), 2, 0.0)]
            corner = M.node((0.4, 0.1, 0.1))
            U, R, s = solve(M, E, nu, held, w[:, None] * np.array((0, -1.0, 0)), np.array([corner]), a.work, 'beam')
            back = np.nansum(R[end, 1]) + w[end].sum()     # ccx counts the load at a held node into RF
            assert abs(back / volume - 1) < 1e-4, back
            runs.append(dict(bricks='%d along x %d x %d in one quarter' % (4 * n, n, n), elements=len(M.elem), nodes=len(M.x),
                             corners=r7(U[corner, 1]), solve_s=round(s, 1)))
            print('clamped_beam', nu, runs[-1], flush=True)
        cases['%g' % nu] = dict(nu=nu, value=runs[-1]['corners'], convergence=change(runs, 'corners'), by_mesh_size=runs)
    return dict(
        geometry='beam [0,0.4]x[0,0.1]x[0,0.1]; computed on one quarter by symmetry, elements shrinking towards the clamped face and the sides',
        E=E, supports='end face x = 0: all displacements zero', load='body force 1 per volume along -y',
        measured='displacement along y, mean of the four corners of the end face x = 0.4', by_nu=cases)

# ---------------------------------------------------------------- clamped plate
def clamped_plate(a):
    """The quarter y in [2, 4], z in [0.25, 0.5]: symmetric about y = 2; about z = 0.25 the motion along z is even and the rest odd."""
    E, nu, runs = 1000.0, 0.3, []
    for n in (2, 4, 6)[:a.sizes]:
        M = Mesh([graded(0, 10, 10 * n, True, False, 2), graded(2, 4, 4 * n, False, True, 1.5), graded(0.25, 0.5, n, False, True, 1.5)])
        def planes(M):
            y, z = (np.unique(M.face(d, False)) for d in (1, 2))
            return [(y, 1, 0.0), (z, 0, 0.0), (np.setdiff1d(z, y), 1, 0.0)]
        r = loaded(M, E, nu, [(0, False)], [(0, True)], 0.5, (0, 0, 0.25), (10, 2, 0.25), planes, a.work, 'plate')
        runs.append(dict(bricks='%d along x, %d over half the width, %d over half the thickness' % (10 * n, 4 * n, n), **r))
        print('clamped_plate', runs[-1], flush=True)
    return dict(
        geometry='plate [0,10]x[0,4]x[0,0.5]; computed on one quarter by symmetry, elements shrinking towards the clamped face and the sides',
        E=E, nu=nu, supports='end face x = 0: all displacements zero',
        load='total force 1 along +z, uniform traction over the end face x = 10',
        value=dict(mean_displacement_loaded_face=runs[-1]['mean'], displacement_at_10_2_0p25=runs[-1]['point']),
        measured='displacement along z', convergence=dict(mean=change(runs, 'mean'), point=change(runs, 'point')), by_mesh_size=runs)

# ---------------------------------------------------------------- plate with a hole
def plate_with_hole(a):
    """A quarter of half the thickness: z = 0 is the middle plane. Stresses at the hole, x = 0, from the displacements of its
    surface: hoop strain -du_x/dt / r, t the angle, and du_z/dz; free of traction across."""
    E, nu, side, r, t, runs = 200e3, 0.3, 100.0, 10.0, 5.0, []
    def place(p):
        u, v, z = p.T; c, s = np.cos(v * PI / 2), np.sin(v * PI / 2)
        out = side / np.maximum(c, s)
        d = r + (out - r) * u ** 2
        return np.stack([d * c, d * s, z], -1)
    for n in (4, 6, 8, 10)[:a.sizes]:
        M = Mesh([even(0, 1, 2 * n), even(0, 1, 4 * n), even(0, t, n)], place)
        hole = np.unique(M.face(0, False))
        outer = M.face(0, True); right = outer[np.abs(M.x[outer][:, :, 0] - side).max(1) < 1e-9]
        w, area = weights(M, right)
        assert abs(area / side / t - 1) < 1e-9, area
        held = [(np.unique(M.face(1, True)), 0, 0.0), (np.unique(M.face(1, False)), 1, 0.0), (np.unique(M.face(2, False)), 2, 0.0)]
        U, R, s = solve(M, E, nu, held, w[:, None] * np.array((10.0, 0, 0)), hole, a.work, 'hole')
        back = np.nansum(R[np.unique(M.face(1, True)), 0])
        assert abs(back / (10 * side * t) + 1) < 1e-4, back
        step, dz = PI / 2 / (8 * n), t / (2 * n)           # between neighbouring nodes
        def at(k, z): return U[M.node(place(np.array([[0, 1 - k / (8 * n), z]]))[0])]
        def stress(z):
            hoop = (8 * at(1, z)[0] - at(2, z)[0]) / (6 * step * r)
            if z == 0: along = (8 * at(0, dz)[2] - at(0, 2 * dz)[2]) / (6 * dz)
            elif z == t: along = (3 * at(0, t)[2] - 4 * at(0, t - dz)[2] + at(0, t - 2 * dz)[2]) / (2 * dz)
            else: along = (at(0, z + dz)[2] - at(0, z - dz)[2]) / (2 * dz)
            return E / (1 - nu ** 2) * (hoop + nu * along)
        all = np.array([stress(2 * dz * i) for i in range(n)] + [stress(t)])   # at corners: faces have no middle nodes
        mean = (all[0] + all[-1] + 4 * all[1::2].sum() + 2 * all[2:-1:2].sum()) / (3 * n)
        runs.append(dict(bricks='%d from the hole outwards, %d around, %d over half the thickness' % (2 * n, 4 * n, n), elements=len(M.elem),
                         nodes=len(M.x), middle=r7(all[0]), surface=r7(all[-1]), mean=r7(mean), solve_s=round(s, 1)))
        print('plate_with_hole', runs[-1], flush=True)
    return dict(
        geometry='plate of 200 x 200 x 10 with a round hole of radius 10; computed on an eighth by symmetry',
        units='mm, N, MPa', E=E, nu=nu, supports='symmetry', load='10 MPa along x at both ends',
        measured='xx at the hole, x = 0: in the middle plane, at the surface, and mean over the thickness',
        value={k: runs[-1][k] for k in ('middle', 'surface', 'mean')}, convergence={k: change(runs, k) for k in ('middle', 'surface', 'mean')},
        by_mesh_size=runs)

CASES = dict(half_ring=half_ring, quarter_sphere=quarter_sphere, bonded_block=bonded_block, bracket=bracket,
             clamped_beam=clamped_beam, clamped_plate=clamped_plate, plate_with_hole=plate_with_hole)

def main():
    ap = argparse.ArgumentParser()
    ap.add_argument('--work', default='/tmp/curved_ref'); ap.add_argument('--only', choices=list(CASES))
    ap.add_argument('--sizes', type=int, default=9, help='only the first N mesh sizes (trial)')
    ap.add_argument('--out', default=os.path.join(HERE, 'curved.json'))
    a = ap.parse_args()
    os.makedirs(a.work, exist_ok=True)
    old = json.load(open(a.out))['cases'] if a.only and os.path.exists(a.out) else {}
    ver = subprocess.run(['ccx', '-v'], capture_output=True, text=True).stdout.split()[-1]
    about = dict(solver='CalculiX ccx ' + ver, elements='C3D20R (20 nodes, reduced integration), *STATIC, no NLGEOM',
                 units='none (E = 1000) unless a case says so', linear='all displacements scale with the load and with 1/E',
                 value='of the finest mesh', convergence='relative change of the value between the last two meshes')
    for name, run in CASES.items():
        if a.only and name != a.only: continue
        old[name] = run(a)
        with open(a.out, 'w') as f: json.dump(dict(about=about, cases=old), f, indent=1); f.write('\n')

if __name__ == '__main__': main()
