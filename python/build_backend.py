# SPDX-License-Identifier: MIT
"""Makes the wheel, for pip and `python3 -m build` (PEP 517), with nothing but CMake and the standard
library. It builds the module in build/wheel; with QUADRILLE_BUILD_DIR it takes the package of that
build instead, which has to be one for the same Python."""

import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SUMMARY = "Exact multi-agent path finding, on grids and in continuous time"


def project_version():
    """The one of CMake's project."""
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(quadrille VERSION ([0-9.]+)", text).group(1)


def wheel_tag():
    implementation = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = re.sub(r"[^A-Za-z0-9]", "_", sysconfig.get_platform())
    return f"{implementation}-{implementation}-{platform}"


def metadata():
    readme = (ROOT / "docs/python.md").read_text(encoding="utf-8")
    return (
        "Metadata-Version: 2.1\n"
        "Name: quadrille\n"
        f"Version: {project_version()}\n"
        f"Summary: {SUMMARY}\n"
        "License: MIT\n"
        "Requires-Python: >=3.9\n"
        "Requires-Dist: numpy\n"
        "Provides-Extra: all\n"
        'Requires-Dist: networkx; extra == "all"\n'
        'Requires-Dist: pandas; extra == "all"\n'
        "Description-Content-Type: text/markdown\n"
        f"\n{readme}"
    )


def built_package():
    """The folder of the package, built."""
    given = os.environ.get("QUADRILLE_BUILD_DIR")
    if given:
        return pathlib.Path(given) / "python/quadrille"
    build = ROOT / "build/wheel"
    arguments = [
        "-DCMAKE_BUILD_TYPE=Release",
        "-DQUADRILLE_PYTHON=ON",
        "-DQUADRILLE_BUILD_TESTS=OFF",
        "-DQUADRILLE_BUILD_CLI=OFF",
        f"-DPython_EXECUTABLE={sys.executable}",
        *os.environ.get("QUADRILLE_CMAKE_ARGS", "").split(),
    ]
    # scripts/setup brings ninja, and no make.
    if shutil.which("ninja") and "CMAKE_GENERATOR" not in os.environ and not build.exists():
        arguments.append("-GNinja")
    subprocess.run(["cmake", "-S", ROOT, "-B", build, *arguments], check=True)
    jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
    subprocess.run(
        ["cmake", "--build", build, "--target", "quadrille_python", "--parallel", jobs], check=True
    )
    return build / "python/quadrille"


def contents(package):
    """(name in the wheel, bytes) of all files but the list of them."""
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    modules = list(package.glob(f"_core*{suffix}"))
    if len(modules) != 1:
        raise RuntimeError(f"{package} has no module for this Python (*{suffix})")
    for file in sorted(package.iterdir()):
        if file.suffix in (".py", ".pyi") or file.name == "py.typed" or file in modules:
            yield f"quadrille/{file.name}", file.read_bytes()
    info = f"quadrille-{project_version()}.dist-info"
    yield f"{info}/METADATA", metadata().encode()
    wheel = f"Wheel-Version: 1.0\nGenerator: quadrille\nRoot-Is-Purelib: false\nTag: {wheel_tag()}\n"
    yield f"{info}/WHEEL", wheel.encode()
    yield f"{info}/LICENSE", (ROOT / "LICENSE").read_bytes()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = f"quadrille-{project_version()}-{wheel_tag()}.whl"
    record = []
    with zipfile.ZipFile(
        pathlib.Path(wheel_directory) / name, "w", compression=zipfile.ZIP_DEFLATED
    ) as wheel:

        def add(path, data):
            # The same bytes whenever it is built.
            entry = zipfile.ZipInfo(path, (2020, 1, 1, 0, 0, 0))
            entry.external_attr = (0o755 if path.endswith(".so") else 0o644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)

        for path, data in contents(built_package()):
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record.append(f"{path},sha256={digest},{len(data)}")
            add(path, data)
        path = f"quadrille-{project_version()}.dist-info/RECORD"
        add(path, "\n".join([*record, f"{path},,", ""]).encode())
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("the source is a git repository; build a wheel: --wheel")
