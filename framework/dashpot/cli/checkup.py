"""What is looked at in an installation, one function each; each answers with findings."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from dashpot.contract.registry import Registry

State = Literal["good", "note", "fault"]
Installed = Callable[[str], str | None]

REQUIREMENT = re.compile(r"([\w.-]+)(\[[\w,.-]+\])?\s*\(?([^;()]*)\)?\s*(?:;.*?extra\s*==\s*['\"]([\w-]+)['\"].*)?")
COMPARISONS: dict[str, Callable[[tuple, tuple], bool]] = {
    ">=": lambda a, b: a >= b,
    "<=": lambda a, b: a <= b,
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
    ">": lambda a, b: a > b,
    "<": lambda a, b: a < b,
}
PURPOSES = {
    "matlab73": "reads MATLAB 7.3 and HDF5 files",
    "excel": "reads Excel workbooks",
    "boosting": "boosted trees for the explainable error",
    "cluster": "campaigns on local processes or a Dask cluster",
    "parquet": "tables of campaigns as Parquet files",
    "sampler": "draws from the posterior of a fit",
    "pandas": "gives tables as data frames in Python",
    "plot": "draws figures in notebooks, plot() of every result",
    "docs": "builds the documentation",
    "dev": "runs the tests",
}
NETWORK_FOLDERS = ("networks", "rigs", "studies")
SPACE, LARGE = 100e6, 1e9

# compiled in the cache folder, as a network is
PROBE = """define void @run(ptr %answer) {
  store double 42.0, ptr %answer
  ret void
}
"""


@dataclass(frozen=True)
class Finding:
    """What was found of one thing; ``advice`` is what to do about it, empty where nothing is to be done."""

    state: State
    what: str
    found: str
    advice: str = ""


@dataclass(frozen=True)
class Requirement:
    """A library that is asked for: ``wanted`` such as `>=2,<3`, ``extra`` where it is optional."""

    name: str
    wanted: str
    extra: str

    @classmethod
    def of(cls, text: str) -> Requirement:
        """The requirement as it stands in the metadata of a distribution."""
        match = REQUIREMENT.fullmatch(text.strip())
        assert match is not None, text
        return cls(match[1], match[3].replace(" ", ""), match[4] or "")

    def met_by(self, version: str) -> bool:
        """Whether a version is one that is asked for."""
        parts = re.findall(r"(>=|<=|==|!=|>|<)([\w.]+)", self.wanted)
        return all(COMPARISONS[sign](numbers_of(version), numbers_of(bound)) for sign, bound in parts)


def numbers_of(version: str) -> tuple[int, ...]:
    """`2.1.3rc1` as (2, 1, 3), without zeros at the end."""
    found = [int(part) for part in re.match(r"\d+(?:\.\d+)*", version)[0].split(".")]  # type: ignore[index]
    while found and found[-1] == 0:
        found.pop()
    return tuple(found)


def python(wanted: str, version: Sequence[int] = sys.version_info[:3]) -> Iterator[Finding]:
    """The version of Python against the one that is asked for, such as `>=3.11`."""
    running = ".".join(map(str, version))
    if Requirement("python", wanted, "").met_by(running):
        yield Finding("good", "Python", running)
    else:
        yield Finding(
            "fault",
            "Python",
            f"{running}, expected {wanted}",
            "install another Python and dashpot into an environment of it",
        )


def libraries(requirements: Iterable[Requirement], installed: Installed) -> Iterator[Finding]:
    """The libraries that dashpot cannot do without."""
    for required in requirements:
        if required.extra:
            continue
        version = installed(required.name)
        advice = f"pip install '{required.name}{required.wanted}'"
        if version is None:
            yield Finding("fault", required.name, f"missing, expected {required.wanted or 'any version'}", advice)
        elif not required.met_by(version):
            yield Finding("fault", required.name, f"{version}, expected {required.wanted}", advice)
        else:
            yield Finding("good", required.name, version)


def extras(requirements: Iterable[Requirement], installed: Installed, registry: Registry) -> Iterator[Finding]:
    """The libraries that add something."""
    optional: dict[str, list[Requirement]] = {}
    for required in requirements:
        if required.extra and required.name != "dashpot":
            optional.setdefault(required.extra, []).append(required)
    for extra, needed in optional.items():
        absent = [each.name for each in needed if not _usable(each, installed)]
        what, gives = f"extra '{extra}'", purpose_of(extra, registry)
        if absent:
            yield Finding(
                "note", what, f"{gives}; not installed: {', '.join(absent)}", f"pip install 'dashpot[{extra}]'"
            )
        else:
            yield Finding("good", what, gives)


def _usable(required: Requirement, installed: Installed) -> bool:
    version = installed(required.name)
    return version is not None and required.met_by(version)


def purpose_of(extra: str, registry: Registry) -> str:
    """What an extra is good for."""
    if extra in registry.optimizers:
        return f"gives the optimizer '{extra}'"
    if extra in registry.formats:
        return f"reads the format '{extra}'"
    return PURPOSES.get(extra, "adds to dashpot")


def plugins(registry: Registry) -> Iterator[Finding]:
    """What plugins there are, and what is wrong with them."""
    for origin in registry.plugins:
        brought = sum(holder == origin for holder in registry.origins.values())
        faults = [fault.message for fault in registry.faults if fault.origin == origin]
        for message in faults:
            advice = f"correct, update or uninstall {origin.distribution}; DASHPOT_PLUGINS leaves a plugin out"
            yield Finding("fault", f"plugin {origin}", f"set aside: {message}", advice)
        if not faults:
            yield Finding("good", f"plugin {origin}", f"brings {brought} things")
    if not registry.elements:
        yield Finding(
            "fault",
            "elements",
            "no plugin gives an element",
            "install dashpot anew: pip install --force-reinstall dashpot",
        )


def specs(folder: Path) -> Iterator[Finding]:
    """The shipped networks, rigs and studies."""
    for name in NETWORK_FOLDERS:
        count = len(list((folder / name).rglob("*.yaml")))
        if count:
            yield Finding("good", f"shipped {name}", str(count))
        else:
            yield Finding(
                "fault",
                f"shipped {name}",
                f"expected YAML files in {folder / name}, found none",
                "install dashpot anew: pip install --force-reinstall dashpot",
            )


def cache(folder: Path) -> Iterator[Finding]:
    """The folder for compiled networks: may it be written, and how large has it become?"""
    advice = "let the environment variable DASHPOT_CACHE name a folder that may be written"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        trial = folder / f".trial-{os.getpid()}"
        trial.write_bytes(b"")
        trial.unlink()
        files = [path for path in folder.rglob("*") if path.is_file()]
        size = sum(path.stat().st_size for path in files)
    except OSError as error:
        found = f"{folder}: {error.strerror}; each call compiles anew"
        yield Finding("note", "cache folder", found, advice)
        return
    found = f"{folder}: {len(files)} files, {size / 1e6:.1f} MB"
    if size > LARGE:
        yield Finding("note", "cache folder", found, "the folder may be deleted; what is needed is compiled anew")
    else:
        yield Finding("good", "cache folder", found)
    free = _free_space(folder)
    if free < SPACE:
        yield Finding("fault", "space", f"{free / 1e6:.0f} MB left for the cache folder", f"make room, or {advice}")


def _free_space(folder: Path) -> int:
    import shutil

    return shutil.disk_usage(folder).free


def compiler(text: str = PROBE) -> Iterator[Finding]:
    """Is a function compiled, kept and right?"""
    anew = "pip install --force-reinstall llvmlite"
    # the compiler is foreign code and may raise anything, down to a failure to load its shared library
    try:
        import numpy as np

        from dashpot.kernel.targets.llvm.native import load_native

        answer = np.zeros(1)
        compiled = load_native(text, 1)
        compiled(answer)
    except Exception as error:
        yield Finding("fault", "compiler", f"{type(error).__name__}: {' '.join(str(error).split())[:200]}", anew)
        return
    if answer[0] != 42.0:
        yield Finding("fault", "compiler", f"expected 42 from a compiled function, got {answer[0]:g}", anew)
    else:
        yield Finding("good", "compiler", "compiles")


def threads(cores: int) -> Iterator[Finding]:
    """How many workers a fit takes."""
    limit = os.environ.get("NUMBA_NUM_THREADS") or os.environ.get("OMP_NUM_THREADS")
    found = f"{cores} cores, so --jobs is {cores} unless said otherwise"
    yield Finding("good", "threads", found + (f"; limited by the environment to {limit}" if limit else ""))
