# Five commands for developers: make setup, test, lint, docs, bench. One for guests: make demo.
# All that is needed is Python 3.11 or newer with pip and venv.

PYTHON ?= $(firstword $(foreach name,python3.11 python3.12 python3.13 python3.14 python3 python,$(shell command -v $(name) 2>/dev/null)))
VENV ?= .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet --no-input
SOURCES := src tests examples benchmarks docs

.PHONY: setup demo test test-all lint format docs bench constraints clean
.DEFAULT_GOAL := setup

setup: $(VENV)/.installed-test

demo: setup
	$(BIN)/eyeline demo --output demo
	@echo "The film and its pictures are in $(CURDIR)/demo"

test: lint
	$(BIN)/python -m pytest -m "not slow" -q

test-all: lint
	$(BIN)/python -m pytest -q

lint: setup
	$(BIN)/ruff check $(SOURCES)
	$(BIN)/ruff format --check $(SOURCES)
	$(BIN)/mypy
	$(BIN)/lint-imports

format: setup
	$(BIN)/ruff check --fix $(SOURCES)
	$(BIN)/ruff format $(SOURCES)

docs: $(VENV)/.installed-docs
	$(BIN)/python -m sphinx -W --keep-going -q -b html docs docs/_build/html
	@echo "The site begins at $(CURDIR)/docs/_build/html/index.html"

bench: $(VENV)/.installed-bench
	$(BIN)/python -m benchmarks
	$(BIN)/python -m benchmarks.table

# The versions the tests passed with, written down; to be run after an upgrade.
constraints: $(VENV)/.installed-docs $(VENV)/.installed-bench
	{ sed -n '/^#/p' constraints.txt; $(PIP) freeze --exclude-editable | LC_ALL=C sort -f; } > constraints.new
	mv constraints.new constraints.txt

clean:
	rm -rf demo build dist docs/_build docs/gallery docs/methods/steps docs/api .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache
	find src tests examples benchmarks docs -name __pycache__ -type d -prune -exec rm -rf {} +

# --- what is installed ------------------------------------------------------------------------------------
# A stamp is newer than what it was installed from, so that a second `make setup` does nothing.

$(VENV)/bin/python:
	@test -n "$(PYTHON)" || { echo "No Python found; install Python 3.11 or newer, or say make PYTHON=/path/to/python"; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "$(PYTHON) is too old; Python 3.11 or newer is needed: make PYTHON=/path/to/python"; exit 1; }
	$(PYTHON) -m venv $(VENV)

$(VENV)/.installed-test: $(VENV)/bin/python pyproject.toml constraints.txt
	$(PIP) install -c constraints.txt -e ".[test,lint]"
	@touch $@

$(VENV)/.installed-docs: $(VENV)/.installed-test
	$(PIP) install -c constraints.txt -e ".[docs]"
	@touch $@

$(VENV)/.installed-bench: $(VENV)/.installed-test
	$(PIP) install -c constraints.txt -e ".[bench]"
	@touch $@
