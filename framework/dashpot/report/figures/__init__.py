"""The figures of a report, one a file: plain arrays in SI units in, a `Figure` in rig units out.

Simulations come under a *label*: "before", "after", or the name of a model; a label has the same colour everywhere.
"""

from __future__ import annotations

from dashpot.report.figures.causes import cause_map
from dashpot.report.figures.conditions import over_conditions
from dashpot.report.figures.contact import contact_models, contact_response
from dashpot.report.figures.control import control_chart
from dashpot.report.figures.convergence import convergence_history
from dashpot.report.figures.curves import identified_curves
from dashpot.report.figures.dependence import metric_band, metric_lines
from dashpot.report.figures.draws import corner, draw_ranks, draw_traces
from dashpot.report.figures.gain import gain_intervals
from dashpot.report.figures.harmonics import harmonic_bars
from dashpot.report.figures.loop import branch_loops, loops
from dashpot.report.figures.misfit import misfit_map
from dashpot.report.figures.residual_map import residual_map
from dashpot.report.figures.residuals import residual_traces
from dashpot.report.figures.rmse import rmse_bars
from dashpot.report.figures.shapes import shape_figure
from dashpot.report.figures.slow import slow_curves
from dashpot.report.figures.specimens import number_over
from dashpot.report.figures.steady import steady_stiffness, stiffness_figures
from dashpot.report.figures.stiffness import dynamic_stiffness
from dashpot.report.figures.velocity import velocity_curves

__all__ = [
    "branch_loops",
    "cause_map",
    "contact_models",
    "contact_response",
    "control_chart",
    "convergence_history",
    "corner",
    "draw_ranks",
    "draw_traces",
    "dynamic_stiffness",
    "gain_intervals",
    "harmonic_bars",
    "identified_curves",
    "loops",
    "metric_band",
    "metric_lines",
    "misfit_map",
    "number_over",
    "over_conditions",
    "residual_map",
    "residual_traces",
    "rmse_bars",
    "shape_figure",
    "slow_curves",
    "steady_stiffness",
    "stiffness_figures",
    "velocity_curves",
]
