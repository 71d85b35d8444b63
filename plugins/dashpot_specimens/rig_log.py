"""What the rig writes down: sampled channels with sensor noise, as CSV or NPZ, and the dataset.yaml over them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.signal import lfilter


@dataclass(frozen=True)
class Record:
    """One measured run: time [s], displacement [m], force [N], shape (samples,); `entry` is its line in the dataset."""

    file: str
    entry: str
    time: np.ndarray
    displacement: np.ndarray
    force: np.ndarray


def add_noise(rng: np.random.Generator, displacement: np.ndarray, force: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """1 um on the displacement, 9 N of coloured noise on the force."""
    noise = coloured_noise(rng, force.size, 9.0)
    jitter = 1e-6 * rng.standard_normal(displacement.size)
    return displacement + jitter, force + noise


def coloured_noise(rng: np.random.Generator, size: int, level: float) -> np.ndarray:
    """Noise of standard deviation `level`, half of its power white, half remembered by 0.9 per sample."""
    white, driven = rng.standard_normal((2, size))
    driven[1:] *= np.sqrt(1 - 0.9**2)
    return level * np.sqrt(0.5) * (white + lfilter([1.0], [1.0, -0.9], driven))


def is_measured(folder: Path, head: str, what: str) -> bool:
    """Whether the dataset of this head is in a folder already. FileExistsError where it holds another dataset."""
    target = folder / "dataset.yaml"
    if target.exists() and not target.read_text(encoding="utf-8").startswith(head):
        raise FileExistsError(f"{target}: expected {what}, got another dataset; use an empty folder")
    return target.exists()


def sweep_name(amplitude: float, preload: float) -> str:
    """What a sweep of an amplitude and a preload, in m, is called."""
    return f"a{amplitude * 1e3:g}_p{preload * 1e3:g}".replace(".", "")


def sweep_settings(amplitude: float, preload: float, start: float, stop: float) -> str:
    """The settings of a sweep, lengths in m and frequencies in Hz, as its line in the dataset has them."""
    lengths = f"amplitude: {amplitude * 1e3:g} mm, preload: {preload * 1e3:g} mm"
    return f"{{{lengths}, start: {start:g} Hz, stop: {stop:g} Hz}}"


def write_records(folder: Path, head: str, records: list[Record]) -> Path:
    """Write all files, dataset.yaml last; returns its path."""
    folder.mkdir(parents=True, exist_ok=True)
    for record in records:
        write = _write_csv if record.file.endswith(".csv") else _write_npz
        write(folder / record.file, record)
    part = folder / "dataset.part"
    part.write_text(head + "".join(record.entry for record in records), encoding="utf-8")
    return part.replace(folder / "dataset.yaml")


def _write_npz(path: Path, record: Record) -> None:
    """Millimetres to 0.1 um and newtons to 0.1 N."""
    np.savez_compressed(path, t=record.time, x=np.round(record.displacement * 1e3, 4), F=np.round(record.force, 1))


def _write_csv(path: Path, record: Record) -> None:
    """Semicolons, decimal commas, a row of units, comments on top: the way many rigs do."""
    columns = (record.time, record.displacement * 1e3, record.force * 1e-3)
    rows = [f"{t:.3f};{x:.4f};{f:.4f}" for t, x, f in zip(*columns, strict=True)]
    head = ["# single-axis hydropulser, load cell under the platform", "# force positive in compression"]
    text = "\n".join([*head, "Time;Displacement;Force", "s;mm;kN", *(row.replace(".", ",") for row in rows)])
    path.write_text(text + "\n", encoding="utf-8", newline="\n")
