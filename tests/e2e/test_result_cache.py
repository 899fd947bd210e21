"""Results for ParaView: every file is read by Python's own XML, and the numbers are compared with closed forms."""

import base64
import glob
import itertools
import os
import struct
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

from sbfmt_program import PROGRAM, ProgramTest, call, main

NUMBERS = {"Float32": "f", "Float64": "d", "UInt32": "I", "UInt8": "B"}
DENSITY, YOUNG, POISSON, GRAVITY = 1000, 500000, 0.3, 10


def numbers(*values):
    return " ".join(f"{value:.9g}" for value in values)


def box(cells, step, pins, more=""):
    """A bundle of a box of tetrahedra, Kuhn's six in a cell, mirrored from cell to cell; `pins` takes the points."""
    counts = [n + 1 for n in cells]
    points = [(x * step, y * step, z * step) for z in range(counts[2]) for y in range(counts[1]) for x in range(counts[0])]
    number = lambda at: at[0] + counts[0] * (at[1] + counts[1] * at[2])
    tetrahedra = []
    for cell in itertools.product(*(range(n) for n in cells)):
        for order in itertools.permutations(range(3)):
            corner, corners = [c % 2 for c in cell], []
            corners.append(number([c + k for c, k in zip(cell, corner)]))
            for axis in order:
                corner[axis] = 1 - corner[axis]
                corners.append(number([c + k for c, k in zip(cell, corner)]))
            a, b, c, d = (points[k] for k in corners)
            u, v, w = ([q - p for p, q in zip(a, other)] for other in (b, c, d))
            if sum(u[i] * (v[(i + 1) % 3] * w[(i + 2) % 3] - v[(i + 2) % 3] * w[(i + 1) % 3]) for i in range(3)) < 0:
                corners[2], corners[3] = corners[3], corners[2]
            tetrahedra.append(corners)
    listed = " ".join(numbers(*p) for p in points)
    corners = " ".join(numbers(*t) for t in tetrahedra)
    return points, f"""<?xml version="1.0" encoding="UTF-8"?>
<sbf version="1.0">
  <environment gravity="0 -{GRAVITY} 0"/>
  <soft_body id="bar" name="Bar">
    <attributes density="{DENSITY}" young_modulus="{YOUNG}" poisson_ratio="{POISSON}" damping_ratio="1"/>
    <level name="Lattice" model="tetrahedra">
      <positions>{listed}</positions>
      <tetrahedron_mesh target="volume">
        <tetrahedra>{corners}</tetrahedra>
      </tetrahedron_mesh>
      <pins>{pins(points)}</pins>
    </level>{more}
  </soft_body>
</sbf>
"""


def read_array(element):
    raw = base64.b64decode("".join(element.text.split()))
    (size,) = struct.unpack_from("<Q", raw)
    assert len(raw) == 8 + size, "the array is as long as it says"
    kind = NUMBERS[element.get("type")]
    values = struct.unpack_from(f"<{size // struct.calcsize(kind)}{kind}", raw, 8)
    width = int(element.get("NumberOfComponents"))
    return values if width == 1 else [values[i:i + width] for i in range(0, len(values), width)]


def read_frame(path):
    piece = ElementTree.parse(path).getroot().find("UnstructuredGrid/Piece")
    frame = {part: {array.get("Name"): read_array(array) for array in piece.find(part)} for part in ("PointData", "CellData", "Points", "Cells")}
    for part, count in (("PointData", "NumberOfPoints"), ("CellData", "NumberOfCells")):
        for name, values in frame[part].items():
            assert len(values) == int(piece.get(count)), name
    return frame


def read_series(path):
    """The times, and the files beside it."""
    sets = ElementTree.parse(path).getroot().findall("Collection/DataSet")
    return [(float(one.get("timestep")), os.path.join(os.path.dirname(path), one.get("file"))) for one in sets]


class Results(ProgramTest):
    def bundle(self, *what):
        points, text = box(*what)
        path = self.path("bar.sbf")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return points, path

    def run_series(self, bundle, *how):
        self.good("run", bundle, *how, "--cache", self.path("out.pvd"))
        return read_series(self.path("out.pvd"))

    def test_a_bar_supports_its_own_weight(self):
        """Between two layers of points the mean stress is the weight below, over the area."""
        side, layers, step = 2, 8, 0.05
        held = lambda points: '<pin_set name="Top"><points>%s</points></pin_set>' % numbers(
            *(i for i, p in enumerate(points) if p[1] > (layers - 0.5) * step))
        _, bundle = self.bundle((side, layers, side), step, held)
        series = self.run_series(bundle, "--seconds", "4", "--fps", "10", "--raise", "1")
        self.assertEqual([round(time, 6) for time, _ in series], [i / 10 for i in range(41)])
        first, last = read_frame(series[0][1]), read_frame(series[-1][1])
        self.assertTrue(all(max(map(abs, d)) == 0 for d in first["PointData"]["displacement"]))
        start = first["Points"]["points"]
        for a, b, d in zip(start, last["Points"]["points"], last["PointData"]["displacement"]):
            for k in range(3):
                self.assertAlmostEqual(b[k] - a[k], d[k], delta=1e-6)
        corners, ends = last["Cells"]["connectivity"], last["Cells"]["offsets"]
        self.assertEqual(set(last["Cells"]["types"]), {10})
        low = min(p[1] for p in start)
        slabs = [[] for _ in range(layers)]
        for i, stress in enumerate(last["CellData"]["stress"]):
            middle = sum(start[c][1] for c in corners[ends[i] - 4:ends[i]]) / 4 - low
            slabs[int(middle / step)].append((stress, last["CellData"]["strain_energy_density"][i], last["CellData"]["von_mises"][i]))
        for n, slab in enumerate(slabs):
            wanted = DENSITY * GRAVITY * (n + 0.5) * step
            mean = sum(stress[1] for stress, _, _ in slab) / len(slab)
            self.assertAlmostEqual(mean / wanted, 1, delta=0.02, msg=f"slab {n}")
        # Away from the ends the bar is stretched along itself alone.
        wanted, middle = DENSITY * GRAVITY * 4.5 * step, slabs[4]
        self.assertAlmostEqual(sum(mises for _, _, mises in middle) / len(middle) / wanted, 1, delta=0.1)
        self.assertAlmostEqual(sum(energy for _, energy, _ in middle) / len(middle) / (wanted ** 2 / 2 / YOUNG), 1, delta=0.1)
        # The nodes have the mean of the cells about them.
        nodes = [s[1] for s, p in zip(last["PointData"]["stress"], start) if abs(p[1] - low - 4 * step) < 1e-6]
        self.assertAlmostEqual(sum(nodes) / len(nodes) / (DENSITY * GRAVITY * 4 * step), 1, delta=0.1)

    def test_uniform_stretch_follows_the_material_law(self):
        stretch = 1.1
        held = lambda points: '<pin_set name="Hull"><points>%s</points><offsets>%s</offsets></pin_set>' % (
            numbers(*(i for i in range(27) if i != 13)),
            " ".join(numbers(p[0], p[1] * stretch, p[2]) for i, p in enumerate(points) if i != 13))
        _, bundle = self.bundle((2, 2, 2), 0.1, held)
        last = read_frame(self.run_series(bundle, "--seconds", "2", "--fps", "2", "--gravity", "0")[-1][1])
        mu, first = YOUNG / 2 / (1 + POISSON), YOUNG / 2 / (1 + POISSON) / (1 - 2 * POISSON)
        p = first * (stretch - 1) - mu
        along, across = mu * stretch + p, (mu + p * stretch) / stretch
        energy = mu / 2 * (stretch ** 2 - 1) + first / 2 * (stretch - 1 - mu / first) ** 2 - mu ** 2 / 2 / first
        for stress, mises, density in zip(*(last["CellData"][name] for name in ("stress", "von_mises", "strain_energy_density"))):
            for is_, wanted in zip(stress, (across, along, across, 0, 0, 0)):
                self.assertAlmostEqual(is_, wanted, delta=0.002 * along)
            self.assertAlmostEqual(mises / (along - across), 1, delta=0.003)
            self.assertAlmostEqual(density / energy, 1, delta=0.005)
        self.assertTrue(all(abs(ratio - stretch) < 1e-3 for ratio in last["CellData"]["volume_ratio"]))

    def test_failures_leave_no_files(self):
        _, bundle = self.bundle((2, 4, 2), 0.1, lambda points: '<pin_set name="Top"><points>4 5</points></pin_set>')
        with open(self.path("out.pvd"), "w", encoding="utf-8") as file:
            file.write("old")
        # No file may be longer than 4 KiB, as on a disk that is full.
        limited = subprocess.run(["sh", "-c", 'trap "" XFSZ; ulimit -f 8; exec "$0" "$@"', PROGRAM, "run", bundle, "--seconds", "1", "--cache",
            self.path("out.pvd")], capture_output=True, text=True, timeout=100, check=False)
        self.assertEqual(limited.returncode, 2)
        self.assertIn("IO_CANNOT_WRITE", limited.stderr)
        self.assertEqual(glob.glob(self.path("out_*")), [])
        with open(self.path("out.pvd"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "old")
        refused = call("run", bundle, "--cache", self.path("out.pvd"), "--of", "skin")
        self.assertEqual(refused.status, 2)
        self.assertIn("point caches", refused.err)


if __name__ == "__main__":
    main()
