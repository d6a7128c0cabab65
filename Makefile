# make run    sets up .venv, runs the main job, prints where its report is
# make test   sets up what the tests need, runs them
# make check  lint, types, and the built wheel used outside the checkout
# make bench  the figures of docs/benchmarks.md
# make recompile  forgets compiled kernels, after one was changed
# make pictures  the pictures of the documentation, from the main job

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check install --quiet --constraint constraints.txt

.PHONY: run test check lint types wheel bench pictures recompile clean

run: $(VENV)/.installed
	$(BIN)/ssrics run complex --out out/complex

test: $(VENV)/.tests
	$(BIN)/python -m pytest -q -n auto

check: lint types wheel

lint: $(VENV)/.dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(VENV)/.dev
	$(BIN)/mypy

wheel: $(VENV)/.dev
	sh tests/wheel.sh $(BIN)/python

bench: $(VENV)/.tests
	for script in benchmarks/bench_*.py; do $(BIN)/python $$script || exit 1; done

pictures: run
	cp out/complex/figures/map.svg docs/images/complex-map.svg
	cp out/complex/figures/locations.svg docs/images/complex-locations.svg
	$(BIN)/ssrics run closed-door --out out/closed-door
	cp out/closed-door/figures/map.svg docs/images/closed-door-map.svg
	$(BIN)/ssrics run complex -n 1 --set perception=human-like --set productions=landmark --out out/view
	$(BIN)/ssrics view out/view --out out/view.html
	chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --virtual-time-budget=3000 \
	  --window-size=1440,1060 --screenshot=docs/images/view.png "file://$(CURDIR)/out/view.html#t=329.1&why"
	$(BIN)/ssrics run complex -n 6 --set perception=human-like --set productions=landmark --out out/human-like
	$(BIN)/ssrics run complex -n 6 --out out/report
	$(BIN)/ssrics study simulate complex --out out/people.csv
	$(BIN)/ssrics compare out/human-like out/report out/people.csv --out out/compared
	chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --window-size=1200,1180 \
	  --screenshot=docs/images/people.png "file://$(CURDIR)/out/compared/comparison.html"
	cp out/compared/figures/ceiling.svg docs/images/people-ceiling.svg

$(BIN)/python:
	$(PYTHON) -c 'import sys; sys.exit("ssrics-like needs Python 3.11 or newer, this is " + sys.version.split()[0] if sys.version_info < (3, 11) else 0)'
	$(PYTHON) -m venv $(VENV)

$(VENV)/.installed: pyproject.toml constraints.txt | $(BIN)/python
	$(PIP) --editable '.[study]'
	touch $@

$(VENV)/.tests: $(VENV)/.installed
	$(PIP) --editable '.[test]'
	touch $@

$(VENV)/.dev: $(VENV)/.tests
	$(PIP) --editable '.[dev]'
	touch $@

recompile:
	find ssrics_like -name __pycache__ -prune -exec rm -rf {} +

clean: recompile
	rm -rf $(VENV) out dist build
