"""Compiling LLVM assembly, and keeping what comes out.

The machine code is kept in a file that is named by the digest of everything it comes from: the text, the version of the
compiler and the processor. Equal networks, whatever their numbers, share one file, and no file can be out of date. A
program that is known by its digest is not even printed again: a note says which file its text led to.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from dashpot.kernel.cache import keep_sealed, kernel_folder, read_sealed

if TYPE_CHECKING:
    from llvmlite.binding import TargetMachine

Maker = tuple[str, str, str]  # the versions of the compiler, the name and the features of the processor

EFFORT = 2
KEPT = 256


@dataclass(frozen=True, eq=False)
class Native:
    """A function of a compiled text, the file that it came from, and what keeps it in memory."""

    call: Any
    file: Path
    keeper: Any

    def __call__(self, *arguments: np.ndarray | int | None) -> None:
        """Call it with arrays, by their address, and integers; None is no array."""
        self.call(*(_place(argument) for argument in arguments))


def _place(argument: np.ndarray | int | None) -> int | None:
    return argument.__array_interface__["data"][0] if isinstance(argument, np.ndarray) else argument


@dataclass(frozen=True)
class _Kept:
    """A file of machine code for functions of ``count`` arguments, and how it is made where it is missing."""

    file: Path
    count: int
    maker: Maker
    make: Callable[[], bytes] = field(compare=False)


@dataclass(frozen=True)
class _Noted:
    """What is known by a ``mark``, in a folder, for a processor; its text is printed where it is not known."""

    mark: str
    count: int
    folder: Path
    maker: Maker
    text: Callable[[], str] = field(compare=False)


def load_native(text: str, count: int) -> Native:
    """The function ``run`` of a text, with ``count`` arguments, from the cache where it is known."""
    return _of_text(text, count, kernel_folder(), _maker())


def load_known(mark: str, count: int, text: Callable[[], str]) -> Native:
    """The same for a text that follows from all that a ``mark`` stands for; without a mark the text is printed."""
    return _of_mark(_Noted(mark, count, kernel_folder(), _maker(), text)) if mark else load_native(text(), count)


def _maker() -> Maker:
    return stamp(), *processor()


@lru_cache(maxsize=KEPT)
def _of_mark(noted: _Noted) -> Native:
    note = noted.folder / f"{_digest(noted.maker, noted.mark)}.note"
    known = read_sealed(note)
    if known is None:
        found = _of_text(noted.text(), noted.count, noted.folder, noted.maker)
        keep_sealed(note, found.file.name.encode())
        return found
    file, target = noted.folder / known.decode(), noted.maker[1:]
    return _native(_Kept(file, noted.count, noted.maker, lambda: compiled(noted.text(), *target)))


def _of_text(text: str, count: int, folder: Path, maker: Maker) -> Native:
    file = folder / f"{_digest(maker, text)}.o"
    return _native(_Kept(file, count, maker, lambda: compiled(text, *maker[1:])))


def _digest(maker: Maker, content: str) -> str:
    return hashlib.sha256("\n".join([*maker, content]).encode()).hexdigest()[:32]


def processor() -> tuple[str, str]:
    """The name and the features of the processor to compile for; ``DASHPOT_PROCESSOR`` names another than this one."""
    given = os.environ.get("DASHPOT_PROCESSOR")
    return (given, "") if given else _this_processor()


@cache
def _this_processor() -> tuple[str, str]:
    from llvmlite import binding

    return binding.get_host_cpu_name(), binding.get_host_cpu_features().flatten()


def stamp() -> str:
    """The versions of the compiler."""
    import llvmlite
    from llvmlite import binding

    return f"llvmlite {llvmlite.__version__}, LLVM {'.'.join(map(str, binding.llvm_version_info))}, {EFFORT}"


@lru_cache(maxsize=KEPT)
def _native(kept: _Kept) -> Native:
    from llvmlite import binding

    code = read_sealed(kept.file)
    if code is None:
        code = kept.make()
        keep_sealed(kept.file, code)
    engine = binding.create_mcjit_compiler(binding.parse_assembly(""), _machine(*kept.maker[1:]))
    engine.add_object_file(binding.ObjectFileRef.from_data(code))
    engine.finalize_object()
    kind = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * kept.count)
    return Native(kind(engine.get_function_address("run")), kept.file, engine)


def compiled(text: str, name: str, features: str) -> bytes:
    """The machine code of a text."""
    return _machine(name, features).emit_object(_module(text))


def machine_text(text: str) -> str:
    """The same for a reader."""
    return _machine(*processor()).emit_assembly(_module(text))


def _module(text: str) -> Any:
    from llvmlite import binding

    module = binding.parse_assembly(text)
    module.verify()
    return module


@cache
def _ready() -> None:
    from llvmlite import binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()


def _machine(name: str, features: str) -> TargetMachine:
    from llvmlite import binding

    _ready()
    target = binding.Target.from_default_triple()
    return target.create_target_machine(cpu=name, features=features, opt=EFFORT, jit=True)
