"""What people write: texts with positions, quantities with units, and the problems found in them.

- `problem`: Place, Problem, InputError and the nearest known word
- `node`: the parts of a parsed YAML text; `core_schema`: what a plain scalar means; `compose`: from events to nodes
- `document`: a YAML text, read safely, with exact positions for editing in place; `inserting`: edits
- `form`: reading a mapping with all mistakes collected at once
- `quantity`: units at the border, SI inside
"""
