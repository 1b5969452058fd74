PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
# what deriving needs; what the tests need beside; what no newcomer's tests need
CORE := $(VENV)/.installed
STAMP := $(VENV)/.installed-test
ALL := $(VENV)/.installed-ci
# LOCKED=1: the very files whose hashes are in requirements-dev.lock, and no others
ifdef LOCKED
CORE := $(VENV)/.installed-locked
STAMP := $(CORE)
ALL := $(CORE)
endif
INSTALL = $(BIN)/python -m pip install --quiet --disable-pip-version-check

# what Python has compiled is kept: each test that starts a process would compile the program again
export PYTHONDONTWRITEBYTECODE :=

.PHONY: help derive test text rest coverage night thorough mutants dist docs playground site play notes pictures bench accuracy fuzz lint lock clean

help:            ## this list
	@sed -n 's/^\([a-z]*\):.*## /  make \1  \t/p' Makefile

derive: $(CORE) ## walk SO(3), SE(3), SL(3): print every equation, regenerate generated/
	$(BIN)/derive build --print

test: $(STAMP)   ## lint, types, and the tests that take minutes
	@{ command -v cc || command -v gcc || command -v clang; } >/dev/null || \
	  { echo "make test: no C compiler on the path: install gcc or clang" >&2; exit 2; }
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/python -m pytest $(ON) $(if $(SEED),--seed=$(SEED)) $(LEFT) --passed=$(PASSED)

PASSED := build/passed.json
READ := build/text.json
ON := -n 2 --dist worksteal

text: $(STAMP)   ## lint, sentences in both languages, links, layers: what is soon seen
	$(BIN)/ruff check .
	$(BIN)/ruff format --check --quiet derive tests
	$(BIN)/python -m pytest --quick $(ON) --passed=$(READ) $(TEXT)

TEXT := tests/prose tests/project/test_docs.py tests/project/test_faults.py tests/project/test_layers.py \
  tests/record/test_keys.py tests/record/test_uses.py tests/views/test_language.py \
  tests/views/test_both_languages.py

rest: $(ALL)     ## what make test has just left out here, and a sixteenth of what it always leaves out
	$(BIN)/python -m pytest --share=16 $(ON) --without=$(PASSED) $(LEFT) --deselect $(PAGES)

# a page that make test leaves out is for make dist, where only the wheel is
PAGES := tests/project/test_docs.py::test_a_page_runs

# branches that only those cases take which a quick run leaves out, and which are not measured, count as not taken
coverage: $(ALL) ## more tests, and the lines and branches of derive/ that none runs; fails below 95 % of lines
	$(BIN)/python -m pytest --share=2 $(ON) --cov --cov-report= --cov-report=json
	$(BIN)/python -m tests.support.covered 95 92

night: coverage thorough mutants fuzz accuracy ## what continuous integration has no time for: hours

thorough: $(ALL) ## all tests, an hour, in an order by chance
	$(BIN)/python -m pytest --thorough --order=$(or $(SEED),1) $(ON)

mutants: $(ALL) ## hours: every record, emitted program, rule of the engine made wrong; faults by hand
	$(BIN)/python -m tests.support.mutants

lint: $(STAMP)   ## ruff and mypy alone
	$(BIN)/ruff check .
	$(BIN)/mypy

notes: $(CORE)  ## lecture notes of SO(3), SE(3), SL(3): notes.pdf and notes.html
	$(BIN)/derive notes so3 se3 sl3 --out notes.html
	$(BIN)/derive notes so3 se3 sl3 --out notes.pdf

dist: $(ALL)   ## minutes more of tests: wheels, old and new versions, every build of the C
	$(BIN)/python -m pytest --quick -m dist $(ON) -rP $(sort $(shell grep -rl --include='*.py' mark.dist tests))

docs: $(CORE)   ## the site of docs/ and of the docstrings, in build/docs; a dead link is an error
	$(INSTALL) --editable ".[docs]"
	rm -rf build/docs
	$(BIN)/sphinx-build -q -E -W --keep-going $(if $(filter site,$(MAKECMDGOALS)),-t play) -c docs . build/docs

NODE_MODULES := playground/node_modules/.package-lock.json

playground: $(STAMP) $(NODE_MODULES) ## the playground in the browser, a static folder: build/site/play
	$(BIN)/python -m playground.site

site: docs playground ## the documentation and the playground, one static folder: build/site
	cp -R build/docs/. build/site/

play: $(STAMP) $(NODE_MODULES) ## the playground on this machine alone, at an address that is printed
	$(BIN)/python -m playground.site --serve

$(NODE_MODULES): playground/package-lock.json
	@{ command -v node && command -v npm; } >/dev/null || \
	  { echo "make: no Node on the path: install nodejs and npm" >&2; exit 2; }
	npm ci --prefix playground --no-audit --no-fund

lock:            ## the versions that are newest now, and the hashes of their files, into requirements-dev.lock
	rm -rf build/lock
	$(PYTHON) -m venv build/lock
	build/lock/bin/python -m pip install --quiet --disable-pip-version-check uv
	printf 'hatchling\neditables\n' | build/lock/bin/uv pip compile --quiet --upgrade --universal \
	  --generate-hashes --extra ci --no-annotate --no-emit-find-links \
	  --custom-compile-command "make lock; to have these versions: make test LOCKED=1" \
	  --output-file requirements-dev.lock pyproject.toml -
	rm -rf build/lock

pictures: $(ALL) ## the pictures of docs/plot.md, from the runs in examples/runs
	$(BIN)/python -m tests.support.motion_pictures

bench: $(ALL)  ## cost of deriving, growth with the group, emitted code beside its peers
	$(BIN)/python -m benchmarks.road
	$(BIN)/python -m benchmarks.sizes
	$(BIN)/python -m benchmarks.symmetries
	$(BIN)/python -m benchmarks.integrals
	$(BIN)/python -m benchmarks.peers
	$(BIN)/python -m benchmarks.zeitlin
	$(BIN)/python -m benchmarks.motion
	$(BIN)/python -m benchmarks.discrete
	$(BIN)/python -m benchmarks.playground

accuracy: $(ALL) ## worst error of each output against 50 digits, over 100000 states of each problem: an hour
	$(BIN)/python -m benchmarks.accuracy

fuzz: $(ALL)   ## random problems and 100000 changed files of every kind: half an hour; faults go to fuzz-faults/
	EXAMPLES=300 $(BIN)/python -m pytest tests/walk/test_any_problem.py -k random
	$(BIN)/python -m tests.fuzz 100000

clean:           ## remove the virtual environment and caches
	rm -rf $(VENV) .pytest_cache .mypy_cache .ruff_cache

$(VENV)/.installed $(VENV)/.installed-test $(VENV)/.installed-ci: pyproject.toml
	@$(BIN)/python -m pip --version >/dev/null 2>&1 || $(PYTHON) -m venv $(VENV)
	$(INSTALL) --editable ".$(patsubst -%,[%],$(@:$(VENV)/.installed%=%))"
	touch $@

$(VENV)/.installed-locked: pyproject.toml requirements-dev.lock
	@$(BIN)/python -m pip --version >/dev/null 2>&1 || $(PYTHON) -m venv $(VENV)
	$(INSTALL) --require-hashes --requirement requirements-dev.lock
	$(INSTALL) --no-deps --no-build-isolation --editable .
	touch $@
