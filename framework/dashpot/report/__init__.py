"""What people read: the HTML report, terminal tables, canonical JSON.

- `parts`       what a page consists of
- `page`        a page as one HTML file
- `fit`, `comparison`, `diagnosis`, `study`   the pages of the result files; `evidence` what they show besides
- `headline`    the verdict in one sentence
- `figures`     the plots; `theme` their colours, `plot_json` their form on the page and in a notebook
- `grids`       the tables; `tables` writes them as CSV and for the terminal; `patch` two texts line by line
- `json_text`   result files
- `readable`    numbers as an engineer writes them
- `security`    what the page may do; `colophon` where it comes from
"""

from __future__ import annotations

from dashpot.report.comparison import comparison_page
from dashpot.report.diagnosis import diagnosis_page
from dashpot.report.evidence import Evidence
from dashpot.report.json_text import json_text
from dashpot.report.page import write_page

__all__ = ["Evidence", "comparison_page", "diagnosis_page", "json_text", "write_page"]
