"""What a notebook sees: the results of the layers below, which here can show themselves.

- `verbs`       what one calls: load, declare, fit, compare, diagnose ...
- `model`, `data`, `fit`, `comparison`, `diagnosis`   the results, each with a display, tables and plots
- `part`        a branch or a node of a model, whose numbers can be set
- `frames`      runs out of pandas and xarray
- `progress`    a line while something is computed, and how it is cancelled
- `estimator`   a model for the tools of scikit-learn
- `promoted`    from a result of a layer below to one that shows itself
- `numbers`     the parameters of a network as a table
- `listing`     a table in a cell, and as a pandas frame
- `plots`       the figures of the report, for a cell
- `cell`        the parts of a report as HTML for one cell
"""
