"""Measured sets of others as dataset files: runs cut by what drove them, units, signs, settings; no number is copied.

Nearly every run is read where it lies, by the readers that dashpot ships. Each set says where the measurements are
from, what its owners know of them, and which two shipped networks are diagnosed.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path

import yaml
from real import seal

SHARED = Path(os.environ.get("DASHPOT_MEASURED") or Path(__file__).resolve().parents[3] / "shared" / "data")

Entry = dict[str, object]


@dataclass(frozen=True)
class MeasuredSet:
    """One dataset over a folder of measurements by others.

    `cut` says how records became runs; `runs` gives their entries in ``dataset.yaml``; `bases` are shipped networks,
    `known_faults` the faults of the measurement that its owners tell, by the names of dashpot's causes. Each of the
    `seeds` holds out other runs.
    """

    name: str
    folder: str
    title: str
    cut: str
    defaults: Entry
    runs: Callable[[], Iterable[Entry]]
    bases: tuple[str, str] = ("kelvin_voigt", "tire_model_1")
    known_faults: tuple[str, ...] = field(default=())
    seeds: tuple[int, ...] = (0, 1, 2)

    @property
    def owners(self) -> dict[str, str]:
        """``source``, ``url`` and ``licence`` of the measurements, and what their ``owners`` say of them."""
        return yaml.safe_load((Path(__file__).parent / "owners.yaml").read_text(encoding="utf-8"))[self.folder]

    @property
    def present(self) -> bool:
        return (SHARED / self.folder).is_dir()

    def write(self, folder: Path, left_out: Iterable[str] = ()) -> Path:
        """Write ``dataset.yaml`` into `folder`, without the runs `left_out`, and return its path."""
        folder.mkdir(parents=True, exist_ok=True)
        entries = without(list(self.runs()), set(left_out))
        head = {"format": "dashpot-dataset/1", "name": self.title}
        if self.folder == seal.FOLDER:
            seal.write_strokes(SHARED / self.folder, folder, entries)
        else:
            head["folder"] = str(SHARED / self.folder)
        path = folder / "dataset.yaml"
        text = {**head, "defaults": self.defaults, "runs": entries}
        path.write_text(yaml.safe_dump(text, sort_keys=False, width=120), encoding="utf-8")
        return path


def without(entries: list[Entry], gone: set[str]) -> list[Entry]:
    """The entries without some runs; what repeats one of these stands for itself."""
    kept = [entry for entry in entries if entry["name"] not in gone]
    return [{k: v for k, v in entry.items() if k != "repeats" or v not in gone} for entry in kept]


def columns(displacement: tuple[object, str], force: tuple[object, str], **more: object) -> Entry:
    """The channels of a run, from (column, unit)."""
    return {
        **more,
        "displacement": dict(zip(("column", "unit"), displacement, strict=True)),
        "force": dict(zip(("column", "unit"), force, strict=True)),
    }
