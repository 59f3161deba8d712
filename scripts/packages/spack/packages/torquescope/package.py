"""Spack: `spack repo add CLONE/scripts/packages/spack`, then `spack install torquescope`. It builds what is committed
in that clone."""

import pathlib

from spack.package import *

CLONE = pathlib.Path(__file__).resolve().parents[5]


class Torquescope(CMakePackage):
    """Identifies robot dynamics from recordings and names the physics a model lacks."""

    git = CLONE.as_uri()
    license("Apache-2.0")

    version("main", branch="main")

    variant("report", default=True, description="what `torquescope report` and `compare` need of Python")

    depends_on("cxx", type="build")
    depends_on("c", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("eigen@3.4:")
    depends_on("cli11@2.3:")
    depends_on("fmt@9:")
    depends_on("hdf5@1.10:~mpi+hl")
    depends_on("highway@1.0.3:")
    depends_on("matio@1.5.23:")
    depends_on("nlohmann-json@3.11:")
    depends_on("openssl@3:")
    depends_on("tomlplusplus@3:")
    depends_on("urdfdom@3:")
    depends_on("zlib-api")
    with when("+report"):
        depends_on("python@3.10:", type="run")
        depends_on("py-h5py", type="run")
        depends_on("py-numpy", type="run")
        depends_on("py-matplotlib", type="run")
        depends_on("py-jinja2", type="run")

    requires("%gcc@12:", "%clang@15:", policy="one_of", msg="C++20 and OpenMP")

    def cmake_args(self):
        return [
            self.define("TORQUESCOPE_TESTS", False),
            # libraries of Spack are shared and know where they are
            self.define("TORQUESCOPE_STATIC_LIBRARIES", False),
        ]

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def say_the_version(self):
        Executable(self.prefix.bin.torquescope)("--version")
