"""The reader of URDF files, for a Spack that has only its headers."""

from spack.package import *


class Urdfdom(CMakePackage):
    """Parsers of the Unified Robot Description Format."""

    homepage = "https://github.com/ros/urdfdom"
    git = "https://github.com/ros/urdfdom.git"
    license("BSD-3-Clause")

    version("4.0.0", tag="4.0.0")
    version("3.0.1", tag="3.0.1")

    depends_on("cxx", type="build")
    depends_on("console-bridge")
    depends_on("urdfdom-headers")
    depends_on("tinyxml2", when="@4:")
    depends_on("tinyxml", when="@3")
