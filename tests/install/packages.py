"""The packages of `cpack --preset package`: what they ask of a machine, and that they work on one with nothing else.

The .deb is unpacked where its dependencies are installed. The tarball runs in a root of its own (chroot) that holds
glibc and libstdc++ alone; only root may do that. Both end with a verdict on a CSV of somebody's own.
Use: packages.py BUILD_FOLDER SOURCE_FOLDER CPACK
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

BUILD, SOURCE, CPACK = sys.argv[1:4]
sys.path.insert(0, os.path.join(SOURCE, "tests", "jobs"))

import recordings  # noqa: E402

# what scripts/packages/README.md promises: RHEL 9 has these, Ubuntu 22.04 and Debian 12 later ones
NEWEST = {"GLIBC": (2, 34), "GLIBCXX": (3, 4, 29), "CXXABI": (1, 3, 13), "GCC": (7, 0, 0)}
# of every Linux machine with a program in C++: no package brings them
OF_THE_SYSTEM = ("libc.so.6", "libm.so.6", "libstdc++.so.6", "libgcc_s.so.1", "ld-linux-x86-64.so.2")
NEWCOMER_SECONDS, NEWCOMER_COMMANDS = 120, 5  # the promise to a newcomer
SECONDS = 600


def text_of(*names):
    with open(os.path.join(SOURCE, *names), encoding="utf-8") as file:
        return file.read()


VERSION = re.search(r"project\(torquescope VERSION ([0-9.]+)", text_of("CMakeLists.txt"))[1]


def said(*words, **options):
    done = subprocess.run(words, check=False, capture_output=True, text=True, timeout=SECONDS, **options)
    if done.returncode != 0:
        raise AssertionError(f"{words} ended with {done.returncode}:\n{done.stderr}")
    return done.stdout


def versions(file):
    """(name, numbers) of each version of a symbol that the file takes from elsewhere."""
    for line in said("objdump", "-T", file).splitlines():
        found = re.search(r"\*UND\*.*\((GLIBC|GLIBCXX|CXXABI|GCC)_([0-9.]+)\)", line)
        if found:
            yield found[1], tuple(map(int, found[2].split(".")))


def needed(file):
    return set(re.findall(r"NEEDED\s+(\S+)", said("objdump", "-p", file)))


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = tempfile.mkdtemp(prefix="torquescope_packages_")
        cls.addClassCleanup(shutil.rmtree, cls.root)
        said(CPACK, "--config", os.path.join(BUILD, "CPackConfig.cmake"), "-B", cls.root, "-G", "DEB;TGZ")
        made = sorted(name for name in os.listdir(cls.root) if name.endswith((".deb", ".tar.gz")))
        cls.tarball, cls.deb = (os.path.join(cls.root, name) for name in made)
        cls.csv = recordings.text_of(recordings.good_rows(20.0))

    def folder(self, name):
        path = os.path.join(self.root, name)
        os.makedirs(path)
        return path

    def unpacked_tarball(self, folder):
        said("tar", "-xzf", self.tarball, "-C", folder)
        name, = os.listdir(folder)
        return os.path.join(folder, name)

    def write_csv(self, folder):
        with open(os.path.join(folder, "mine.csv"), "w", encoding="utf-8") as file:
            file.write(self.csv)

    def assert_whole(self, prefix):
        share = os.path.join(prefix, "share")
        for name in ("man/man1/torquescope-diagnose.1", "bash-completion/completions/torquescope",
                     "zsh/site-functions/_torquescope", "fish/vendor_completions.d/torquescope.fish",
                     "doc/torquescope/LICENSE", "torquescope/report/build.py", "torquescope/jobs/smoke.toml"):
            self.assertTrue(os.path.isfile(os.path.join(share, name)), name)
        self.assertFalse(os.path.isdir(os.path.join(prefix, "include")))

    def test_deb_names_what_it_needs_and_all_of_it(self):
        self.assertEqual(said("dpkg-deb", "--field", self.deb, "Package").strip(), "torquescope")
        depends = said("dpkg-deb", "--field", self.deb, "Depends")
        for package in ("libc6", "libstdc++6", "libgomp1", "libfmt", "liburdfdom-model"):
            self.assertIn(package, depends)
        self.assertIn("python3-h5py", said("dpkg-deb", "--field", self.deb, "Recommends"))
        # every library it is linked with belongs to a package that it names
        folder = self.folder("deb_needs")
        said("dpkg-deb", "-x", self.deb, folder)
        for library in needed(os.path.join(folder, "usr/bin/torquescope")) - {"ld-linux-x86-64.so.2"}:
            owners = said("dpkg-query", "--search", f"*/{library}")
            self.assertTrue(any(line.split(":")[0] in depends for line in owners.splitlines()), (library, owners))

    def assert_works(self, prefix, folder):
        """The smoke job of the package itself, by the program of the package."""
        program = os.path.join(prefix, "bin/torquescope")
        self.assertIn(f"torquescope {VERSION}", said(program, "--version"))
        said(program, "run", os.path.join(prefix, "share/torquescope/jobs/smoke.toml"), "--out", "smoke.h5", cwd=folder)
        self.assertIn("median", said(program, "show", "smoke.h5", cwd=folder))

    def test_tarball_works_from_any_folder(self):
        folder = self.folder("any")
        prefix = os.path.join(folder, "moved, with a comma and spaces")
        os.rename(self.unpacked_tarball(self.folder("first")), prefix)
        self.assert_works(prefix, folder)

    def test_deb_gives_a_verdict(self):
        folder = self.folder("deb")
        said("dpkg-deb", "-x", self.deb, folder)
        self.assert_whole(os.path.join(folder, "usr"))
        self.assert_works(os.path.join(folder, "usr"), folder)
        self.write_csv(folder)
        program = os.path.join(folder, "usr/bin/torquescope")
        said(program, "init", "mine.csv", "--out", "job.toml", cwd=folder)
        self.assertRegex(said(program, "diagnose", "job.toml", "--out", "mine.h5", cwd=folder), r"[A-Z]{4}")

    def test_tarball_asks_for_no_newer_system_than_it_says(self):
        prefix = self.unpacked_tarball(self.folder("versions"))
        own = os.path.join(prefix, "lib", "torquescope")
        brought = set(os.listdir(own))
        newest = {}
        for file in [os.path.join(prefix, "bin", "torquescope"), *(os.path.join(own, name) for name in brought)]:
            self.assertLessEqual(needed(file), brought | set(OF_THE_SYSTEM), file)
            for name, version in versions(file):
                newest[name] = max(newest.get(name, version), version)
        print("\nthe tarball asks for", ", ".join(f"{name} {'.'.join(map(str, version))}"
                                                  for name, version in sorted(newest.items())))
        self.assertEqual(set(newest), set(NEWEST))
        for name, version in newest.items():
            self.assertLessEqual(version, NEWEST[name], name)

    def bare_root(self):
        """A root with a loader, glibc, libstdc++ and nothing else."""
        root = self.folder("bare")
        for library in OF_THE_SYSTEM:
            where = re.search(rf"{re.escape(library)}.*?=> (\S+)", said("/sbin/ldconfig", "-p"))[1]
            inside = os.path.join(root, "lib64" if library.startswith("ld-") else "lib/x86_64-linux-gnu")
            os.makedirs(inside, exist_ok=True)
            shutil.copy(where, os.path.join(inside, library))
        for name in ("tmp", "home", "proc"):
            os.makedirs(os.path.join(root, name))
        return root

    def test_newcomer_on_a_bare_system(self):
        """From the package to the first verdict on an own CSV: three commands, timed."""
        if os.geteuid() != 0:
            self.skipTest("only root may change the root of a process")
        if subprocess.run(("unshare", "--mount", "true"), check=False, capture_output=True).returncode != 0:
            self.skipTest("this machine allows no mounts of one's own (a container)")
        root = self.bare_root()
        home = os.path.join(root, "home")
        self.write_csv(home)
        bin_folder = "/home/" + os.path.basename(self.tarball).removesuffix(".tar.gz") + "/bin/torquescope"

        # /proc says where a program lies; its mount ends with the process
        enter = 'mount -t proc proc "$1/proc" && exec chroot "$@"'

        def inside(*words):
            return said("unshare", "--mount", "sh", "-c", enter, "sh", root, bin_folder, *words,
                        env={"PATH": "/usr/bin:/usr/sbin", "LC_ALL": "C.UTF-8"})

        commands = [lambda: said("tar", "-xzf", self.tarball, "-C", home),
                    lambda: inside("init", "/home/mine.csv", "--out", "/home/job.toml"),
                    lambda: inside("diagnose", "/home/job.toml", "--out", "/home/mine.h5")]
        began = time.monotonic()
        answers = [command() for command in commands]
        seconds = time.monotonic() - began
        print(f"\nnewcomer: {len(commands)} commands, {seconds:.1f} s from the tarball to the verdict")
        print("\n".join(answers[-1].splitlines()[:6]))
        self.assertRegex(answers[-1], "NAMED|CLASS|PARTLY|NOTHING MISSING|UNEXPLAINED|INSUFFICIENT|FAULT")
        self.assertLessEqual(len(commands), NEWCOMER_COMMANDS)
        self.assertLess(seconds, NEWCOMER_SECONDS)
        self.assertIn(f"torquescope {VERSION}", inside("--version"))
        self.assert_whole(os.path.join(root, os.path.dirname(os.path.dirname(bin_folder)).lstrip("/")))

    def test_the_recipes_are_of_this_version(self):
        """Spack, Apptainer and Docker are not here: their recipes are read, not run."""
        for name in ("torquescope", "urdfdom"):
            path = ("scripts", "packages", "spack", "packages", name, "package.py")
            compile(text_of(*path), path[-2], "exec")
        definition = text_of("scripts", "packages", "torquescope.def")
        self.assertRegex(definition, r"(?m)\ABootstrap: docker\nFrom: debian:12")
        sections = re.findall(r"(?m)^%(\w+)", definition)
        self.assertEqual(sections, ["files", "post", "runscript", "test", "labels", "help"])
        self.assertIn(f"version {VERSION}", definition)
        image = text_of("scripts", "packages", "Dockerfile")
        self.assertEqual(re.findall(r"(?m)^FROM (\S+)", image), 2 * ["debian:12-slim"])
        self.assertIn(f"\nversion: {VERSION}\n", text_of("CITATION.cff"))
        self.assertIn(f"torquescope_{VERSION}_amd64.deb", text_of("scripts", "packages", "README.md"))
        self.assertIn(f"\n## {VERSION}\n", text_of("CHANGELOG.md"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
