"""The Python module: the calls of the library, its errors as exceptions, callbacks, and where it looks for it."""

import ctypes
import json
import os
import subprocess
import sys
import tempfile
import threading
import unittest
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.realpath(os.path.join(HERE, os.pardir, os.pardir))
MODULE = os.path.join(ROOT, "exporters", "python")
sys.path.insert(0, MODULE)
if not os.path.exists(os.environ.get("SBFMT_LIBRARY", "")):
    print("skipped: SBFMT_LIBRARY names no shared library")
    sys.exit(77)
import sbfmt  # noqa: E402
from sbfmt import detail, library, runtime, soft_body  # noqa: E402

LIZARD = os.path.join(ROOT, "examples", "lizard", "lizard.obj")
RIG = os.path.join(ROOT, "examples", "lizard", "lizard.glb")
SAMPLES = os.path.join(ROOT, "spec", "samples")


class ModuleTest(unittest.TestCase):
    def setUp(self):
        own = tempfile.TemporaryDirectory()
        self.addCleanup(own.cleanup)
        self.folder = own.name

    def path(self, name):
        return os.path.join(self.folder, name)


class Calls(ModuleTest):
    def test_convert_build_save_and_load(self):
        source = sbfmt.convert(LIZARD, rig=RIG)
        built = source.build()
        self.assertTrue(built.validate().valid)
        for name, options in (("a.sbf", {}), ("a.sbfz", {}), ("b.sbfz", {"store": True}), ("a.glb", {}), ("b.glb", {"store": True})):
            built.save(self.path(name), **options)
            self.assertIsNone(sbfmt.load(self.path(name)).equals(built))
        for form in ("sbfz", "glb"):
            self.assertGreater(os.path.getsize(self.path(f"b.{form}")), os.path.getsize(self.path(f"a.{form}")))
        self.assertIn("/sbf/", source.equals(built))
        with open(self.path("a.sbf"), "rb") as stream:
            self.assertEqual(stream.read(), built.to_xml())

    def test_info_agrees_with_the_program(self):
        program = os.path.join(os.environ["SBFMT_BUILD_DIR"], "tools", "sbfmt")
        if not os.access(program, os.X_OK):
            self.skipTest("the program is not built")
        built = sbfmt.convert(LIZARD, rig=RIG).build()
        built.save(self.path("a.sbf"))
        reported = json.loads(subprocess.check_output([program, "info", self.path("a.sbf"), "--format", "json"]))
        info = built.info()
        for key in ("format_version", "tetrahedra", "pins", "attachments", "rigid_bodies", "joints", "gait", "levels"):
            self.assertEqual(info[key], reported[key], key)
        for kind, count in info["springs"].items():
            self.assertEqual(count, reported["springs"][kind], kind)
        for one, other in zip(info["sections"], reported["sections"]):
            self.assertEqual({key: one[key] for key in ("name", "vertices", "polygons", "interior_points", "pins")},
                             {key: other[key] for key in ("name", "vertices", "polygons", "interior_points", "pins")})
        self.assertEqual(len(info["bones"]), len(reported["bones"]))
        self.assertAlmostEqual(info["mass"] / reported["mass"], 1, delta=1e-6)
        for one, other in zip(info["bounds"]["min"], reported["bounds"]["min"]):
            self.assertAlmostEqual(one, other, delta=1e-6)

    def test_export(self):
        printed = []
        sbfmt.load(os.path.join(SAMPLES, "valid", "everything.sbf")).export(self.path("a.obj"), report=printed.append)
        self.assertTrue(os.path.exists(self.path("a.obj")))
        self.assertEqual(printed[0].code, "EXPORT_LEFT_OUT")

    def test_repair(self):
        printed = []
        turned = sbfmt.load(os.path.join(SAMPLES, "invalid", "surface_winding.sbf"))
        self.assertIn("SURFACE_WINDING", [one.code for one in turned.validate().findings])
        fixed = turned.fix(report=printed.append)
        self.assertEqual([one.code for one in printed], ["SURFACE_WINDING"])
        self.assertNotIn("SURFACE_WINDING", [one.code for one in fixed.validate().findings])

    def test_versions_and_paths(self):
        self.assertEqual(sbfmt.library_version(), "1.0")
        self.assertEqual(sbfmt.library_path(), os.environ["SBFMT_LIBRARY"])

    def test_assets_may_be_closed(self):
        with sbfmt.load(os.path.join(SAMPLES, "valid", "minimal.sbf")) as asset:
            self.assertEqual(asset.info()["sections"], [])
        with self.assertRaises(ValueError):
            asset.to_xml()
        asset.close()

    def test_threads_may_work_at_once(self):
        results = []
        path = os.path.join(SAMPLES, "valid", "jelly.sbf")
        threads = [threading.Thread(target=lambda: results.append(sbfmt.load(path).build().to_xml())) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(results), 4)
        self.assertEqual(len(set(results)), 1)


class Errors(ModuleTest):
    def test_errors_of_a_bad_file_name_cause_and_location(self):
        with self.assertRaises(sbfmt.Error) as caught:
            sbfmt.load(os.path.join(SAMPLES, "invalid", "bone_before_parent.sbf"))
        error = caught.exception
        self.assertEqual((error.code, error.line, error.path, error.fault),
                         ("BONE_ORDER", 4, "/sbf/skeleton/bone[1]/@parent", "input"))
        self.assertIn("bone_before_parent.sbf:4", str(error))

    def test_other_errors_are_system_errors(self):
        with self.assertRaises(sbfmt.Error) as caught:
            sbfmt.load(self.path("none.sbf"))
        self.assertEqual((caught.exception.code, caught.exception.fault), ("IO_CANNOT_READ", "call"))
        with self.assertRaises(sbfmt.Error) as caught:
            sbfmt.load(os.path.join(SAMPLES, "valid", "minimal.sbf")).save(self.path("no/folder/a.sbf"))
        self.assertEqual(caught.exception.code, "IO_CANNOT_WRITE")

    def test_a_known_extension_is_accepted(self):
        path = os.path.join(SAMPLES, "invalid", "extension_required.sbf")
        with self.assertRaises(sbfmt.Error) as caught:
            sbfmt.load(path)
        self.assertEqual(caught.exception.code, "EXTENSION_REQUIRED")
        with open(path, encoding="utf-8") as stream:
            name = stream.read().split('<extension name="')[1].split('"')[0]
        self.assertIn(name.encode(), sbfmt.load(path, extensions=[name]).to_xml())

    def test_wrong_words(self):
        asset = sbfmt.load(os.path.join(SAMPLES, "valid", "minimal.sbf"))
        with self.assertRaises(ValueError):
            asset.build(interior="jam")
        with self.assertRaises(ValueError):
            sbfmt.convert(LIZARD, up="x")
        with self.assertRaises(ValueError):
            sbfmt.convert(LIZARD, limits="fish")
        printed = []
        try:
            sbfmt.convert(LIZARD, rig=RIG, pins={"nowhere": None}, report=printed.append)
        except sbfmt.Error as error:
            printed.append(error.diagnostic)
        self.assertIn("IMPORT_PIN_UNKNOWN", [message.code for message in printed])


class Callbacks(ModuleTest):
    def setUp(self):
        super().setUp()
        self.source = sbfmt.convert(LIZARD, rig=RIG)

    def test_progress_is_reported(self):
        shares = []
        self.source.build(progress=lambda name, fraction: shares.append((name, fraction)))
        self.assertGreater(len(shares), 3)
        self.assertTrue(all(0 <= fraction <= 1 for _, fraction in shares))

    def test_false_cancels(self):
        with self.assertRaises(sbfmt.Cancelled) as caught:
            self.source.build(progress=lambda name, fraction: False)
        self.assertEqual(caught.exception.code, "CANCELLED")

    def test_exceptions_of_callbacks_are_raised(self):
        def progress(_name, _share):
            raise KeyError("mine")
        with self.assertRaises(KeyError):
            self.source.build(progress=progress)

    def test_warnings_are_reported(self):
        printed = []
        sbfmt.convert(LIZARD, report=printed.append)
        self.assertIn("IMPORT_NO_RIG", [one.code for one in printed])
        self.assertEqual({one.severity for one in printed if one.code == "IMPORT_NO_RIG"}, {"warning"})
        self.assertLessEqual({one.severity for one in printed}, {"warning", "info"})


class Binary(ModuleTest):
    def test_structs_are_those_of_the_headers(self):
        reported = subprocess.check_output([os.environ["SBFMT_STRUCT_SIZES"]], text=True).splitlines()
        self.assertGreater(len(reported), 25)
        for line in reported:
            name, number = line.rsplit(" ", 1)
            struct, _, member = name.partition(".")
            mirrored = {**library.OPTIONS, **runtime.STRUCTS, **detail.STRUCTS, **soft_body.STRUCTS}[struct]
            found = getattr(mirrored, member).offset if member else ctypes.sizeof(mirrored)
            self.assertEqual(found, int(number), name)

    def test_a_missing_library_gives_a_remedy(self):
        environment = {**os.environ, "SBFMT_LIBRARY": self.path("none"), "PYTHONPATH": MODULE}
        done = subprocess.run([sys.executable, "-B", "-c", "import sbfmt; sbfmt.library_path()"], env=environment,
                              capture_output=True, text=True, check=False)
        self.assertIn("SBFMT_LIBRARY", done.stderr.splitlines()[-2] + done.stderr.splitlines()[-1])
        self.assertIn("ImportError", done.stderr)

    def fault(self, content):
        """The message for a library with such a file; None: for a missing library."""
        folder = self.path("lib")
        os.makedirs(folder, exist_ok=True)
        if content is not None:
            with open(os.path.join(folder, "libsbfmt-interchange.so"), "wb") as file:
                file.write(content)
        environment = {**os.environ, "SBFMT_LIBRARY": folder, "PYTHONPATH": MODULE}
        return subprocess.run([sys.executable, "-B", "-c", "import sbfmt; print(sbfmt.library_fault())"], env=environment,
                              capture_output=True, text=True, check=True).stdout.strip()

    def test_why_there_is_no_library(self):
        self.assertIn("is not there for Linux", self.fault(None))
        self.assertIn("take the zip for it", self.fault(b"no library at all, whatever its name says" * 40))
        with open(os.environ["SBFMT_LIBRARY"], "rb") as file:
            whole = file.read()
        self.assertEqual(self.fault(whole), "None")
        renamed = whole.replace(b"libm.so.6\0", b"libm.so.7\0")
        self.assertNotEqual(renamed, whole)
        self.assertIn("needs libm.so.7, which this system does not have", self.fault(renamed))

    def test_the_loaders_error_on_an_older_system(self):
        printed = "/lib/x86_64-linux-gnu/libc.so.6: version `GLIBC_2.35' not found (required by /tmp/x.so)"
        self.assertIn("needs glibc 2.35 or newer", library.fault_in_words(printed))

    def test_an_add_on_has_libraries_of_several_systems_and_uses_its_own(self):
        own = os.environ["SBFMT_LIBRARY"]
        with open(own, "rb") as file:
            arm = bytearray(file.read())
        arm[18:20] = (183).to_bytes(2, "little")  # the machine of an ELF file
        head = bytearray(256)
        head[:2], head[60], head[128:134] = b"MZ", 128, b"PE\0\0\x64\x86"
        others = []
        for folder, name, content in (("arm", os.path.basename(own), arm), ("windows", "sbfmt-interchange.dll", head)):
            os.mkdir(self.path(folder))
            others.append(os.path.join(self.path(folder), name))
            with open(others[-1], "wb") as file:
                file.write(content)
        pack, addon = os.path.join(ROOT, "exporters", "blender", "pack.py"), self.path("addon.zip")
        subprocess.run([sys.executable, "-B", pack, addon, own, *others], check=True)
        with zipfile.ZipFile(addon) as archive:
            manifest = archive.read("soft_body_format/blender_manifest.toml").decode()
            archive.extractall(self.path("installed"))
        for platform in ("linux-x64", "linux-arm64", "windows-x64"):
            self.assertIn(f'"{platform}"', manifest)
            self.assertTrue(os.listdir(self.path(f"installed/soft_body_format/sbfmt/lib/{platform}")))
        environment = {**os.environ, "PYTHONPATH": self.path("installed/soft_body_format")}
        del environment["SBFMT_LIBRARY"]
        found = subprocess.run([sys.executable, "-B", "-c", "import sbfmt; print(sbfmt.library_path())"], env=environment, capture_output=True, text=True,
                               check=True).stdout.strip()
        self.assertEqual(os.path.relpath(found, self.path("installed/soft_body_format")),
                         os.path.join("sbfmt", "lib", library.PLATFORM, os.path.basename(own)))
        again = subprocess.run([sys.executable, "-B", pack, self.path("two.zip"), own, own], capture_output=True, text=True, check=False)
        self.assertEqual((again.returncode, os.path.exists(self.path("two.zip"))), (1, False))
        self.assertIn("the same name and platform", again.stderr)

    def test_a_folder_may_be_named(self):
        os.mkdir(self.path("lib"))
        target = os.environ["SBFMT_LIBRARY"]
        os.symlink(target, os.path.join(self.path("lib"), "libsbfmt-interchange.so"))
        environment = {**os.environ, "SBFMT_LIBRARY": self.path("lib"), "PYTHONPATH": MODULE}
        done = subprocess.run([sys.executable, "-B", "-c", "import sbfmt; print(sbfmt.library_path())"], env=environment,
                              capture_output=True, text=True, check=True)
        self.assertEqual(os.path.realpath(done.stdout.strip()), os.path.realpath(target))


if __name__ == "__main__":
    unittest.main(verbosity=2)
