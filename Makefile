# On a fresh machine:  make demo   or   make test.   Needs Python 3.11 or newer; another one: make PYTHON=/path/to/python3.13
PYTHON ?= $(firstword $(foreach candidate,python3 python3.14 python3.13 python3.12 python3.11,\
    $(shell command -v $(candidate) >/dev/null 2>&1 && $(candidate) -c 'import sys; sys.exit(sys.version_info < (3, 11))' \
        2>/dev/null && echo $(candidate))))
VENV := .venv
BIN := $(VENV)/bin
REPORTS := dashpot-demo

.DELETE_ON_ERROR:
.PHONY: demo test types docs clean

demo: $(VENV)/installed
	$(BIN)/dashpot demo --output $(REPORTS) --force

test: $(VENV)/installed-for-tests
	$(BIN)/ruff check . && $(BIN)/ruff format --check .
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 \
	    $(BIN)/python -m pytest -m "not slow and not real" --numprocesses auto --dist worksteal

types: $(VENV)/installed-for-tests
	$(BIN)/mypy

docs: $(VENV)/installed-for-tests
	$(BIN)/sphinx-build --fresh-env --fail-on-warning --keep-going --quiet docs docs/_build/html
	@echo docs/_build/html/index.html

clean:
	rm -rf $(VENV) $(REPORTS) build dist docs/_build docs/generated

# The stamps are renewed when pyproject.toml changes; the sources are installed in place and need no stamp.
$(VENV)/installed: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --editable .
	touch $@

$(VENV)/installed-for-tests: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --editable '.[dev]'
	touch $@ $(VENV)/installed

$(BIN)/python:
	@test -n "$(PYTHON)" || { echo "dashpot needs Python 3.11 or newer, none was found: install it, or say make PYTHON=/path/to/python" >&2; exit 1; }
	$(PYTHON) -m venv $(VENV)
