"""The page about many specimens: cross-validation goes to the workers of a cluster, to the same scores."""

from __future__ import annotations

import shutil

import numpy as np
import pytest
from architecture.source import ROOT
from docs.test_pages import blocks

import dashpot as dp

PAGE = ROOT / "docs" / "how-to" / "campaign.md"


def test_cross_validation_on_a_cluster(bench, tmp_path, monkeypatch):
    for library in ("distributed", "joblib", "sklearn"):
        pytest.importorskip(library, reason=f"{library} is not installed")
    from sklearn.model_selection import GroupKFold, cross_val_score

    shutil.copytree(bench / "mount", tmp_path / "my")
    monkeypatch.chdir(tmp_path)
    [block] = [text for text in blocks(PAGE, "python") if "cross_val_score" in text]
    names = {"dp": dp}
    exec(block, names)
    data = names["data"]
    here = cross_val_score(dp.Estimator("kelvin_voigt"), data.runs, groups=data.groups, cv=GroupKFold(2))
    assert np.array_equal(names["scores"], here) and here.shape == (2,)
