"""Compiling LLVM assembly, and keeping what comes out.

The machine code is kept in a file that is named by the digest of everything it comes from: the text, the version of the
compiler and the processor. Equal networks, whatever their numbers, share one file, and no file can be out of date.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from dashpot.kernel.targets.cache import keep_sealed, kernel_folder, read_sealed

if TYPE_CHECKING:
    from llvmlite.binding import TargetMachine

EFFORT = 2


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


def load_native(text: str, count: int) -> Native:
    """The function ``run`` of a text, with ``count`` arguments, from the cache where it is known."""
    return _native(text, count, kernel_folder(), (stamp(), *processor()))


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


@lru_cache(maxsize=256)
def _native(text: str, count: int, folder: Path, maker: tuple[str, str, str]) -> Native:
    from llvmlite import binding

    recipe, target = "\n".join([*maker, text]), maker[1:]
    file = folder / f"{hashlib.sha256(recipe.encode()).hexdigest()[:32]}.o"
    code = read_sealed(file)
    if code is None:
        code = compiled(text, *target)
        keep_sealed(file, code)
    engine = binding.create_mcjit_compiler(binding.parse_assembly(""), _machine(*target))
    engine.add_object_file(binding.ObjectFileRef.from_data(code))
    engine.finalize_object()
    kind = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * count)
    return Native(kind(engine.get_function_address("run")), file, engine)


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
