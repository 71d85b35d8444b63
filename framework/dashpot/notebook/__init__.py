"""What a notebook sees: the results of the layers below, which here can show themselves.

- `verbs`       what one calls: load, declare, fit, compare, diagnose ...
- `model`, `data`, `fit`, `comparison`, `diagnosis`   the results, each with a display, tables and plots
- `promoted`    from a result of a layer below to one that shows itself
- `numbers`     the parameters of a network as a table
- `listing`     a table in a cell, and as a pandas frame
- `plots`       the figures of the report, for a cell
- `cell`        the parts of a report as HTML for one cell
"""
