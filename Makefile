VENV := .venv
PYTHON := $(VENV)/bin/python
STAMP := $(VENV)/.ready
# One thread a process: the arrays of most tests are small, and threads of two processes are in each other's way.
ALONE := OMP_NUM_THREADS=1 MKL_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1

# Byte code is kept, whatever the environment says: every command that a test starts would compile all files again.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: setup run test quick proofs coverage check example clean

setup: $(STAMP)
	@$(PYTHON) -m pipeline.system

$(STAMP): pyproject.toml constraints.txt
	@python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "Python 3.11 or newer is needed, found $$(python3 --version)"; exit 2; }
	@python3 -m venv $(VENV) || { echo "python3 -m venv failed; on Debian: apt-get install -y python3-venv"; exit 2; }
	$(PYTHON) -m pip install --quiet --constraint constraints.txt --editable ".[dev]"
	@touch $(STAMP)

run: setup
	$(PYTHON) -m pipeline run

check: $(STAMP)
	$(VENV)/bin/ruff check .
	$(VENV)/bin/ruff format --check .
	$(VENV)/bin/mypy

# Types are checked beside the tests: alone that would leave one of two processors idle.
test: setup
	@$(MAKE) --no-print-directory -j 2 check quick

quick: $(STAMP)
	$(ALONE) $(PYTHON) -m pytest -n 2 -m "not long"

proofs: setup
	$(ALONE) $(PYTHON) -m pytest -n 2 -m long

# The documentation, in build/docs: tutorials, reference, how the verdict is made. It needs no network.
.PHONY: docs
docs: $(STAMP)
	$(ALONE) $(PYTHON) -m sphinx -q -E -W --keep-going docs build/docs
	@echo "build/docs/index.html"

# Every command on two thousand small random tables.
.PHONY: fuzz
fuzz: setup
	$(ALONE) $(PYTHON) -m pytest -n 2 --dist load -m long tests/fuzz

# The wheel in an environment of its own, and what a new user does first.
.PHONY: wheel
wheel: $(STAMP)
	$(PYTHON) -m tests.parastiff.installed

# The two commands and the wheel in a Debian with nothing in it; needs root and debootstrap, see tests/bare/root.sh.
.PHONY: bare
bare: $(STAMP)
	$(PYTHON) -m tests.bare

# Many benches for every effect: hours; what was finished is kept, so that it may be stopped and started again.
coverage: $(STAMP)
	$(PYTHON) -m pipeline.assessment.coverage

# Other ways to predict beyond the fitted loads, on the benches of the challenge: hours, to be stopped and started too.
.PHONY: extrapolation
extrapolation: $(STAMP)
	$(PYTHON) -m pipeline.assessment.extrapolation

# How often the intervals of `predict` hold a reading, on the benches of the challenge: an hour, to be stopped too.
.PHONY: predict
predict: $(STAMP)
	$(PYTHON) -m pipeline.assessment.prediction

# Every criterion of the diagnosis halved and doubled on sixty benches: an hour or two, to be stopped and started too.
.PHONY: sensitivity
sensitivity: $(STAMP)
	$(PYTHON) -m pipeline.assessment.sensitivity

# Twelve kinds of mistakes of a table, and right ones, on benches of the challenge: hours, to be stopped and started too.
.PHONY: mistaken
mistaken: $(STAMP)
	$(PYTHON) -m pipeline.assessment.mistaken

# One effect of the catalogue hidden and left out of it, found again as a law of its place: hours, to be stopped and started too.
.PHONY: left_out
left_out: $(STAMP)
	$(PYTHON) -m pipeline.assessment.left_out

# Bars off, lugs, long tails, knocked readings, rounding, soft drives, each alone on many benches: hours, to be stopped and started too.
.PHONY: doubts
doubts: $(STAMP)
	$(PYTHON) -m pipeline.assessment.doubts

# The shipped campaign, measured again on the virtual bench; what it hides stands here and in its sealed answer.
example: $(STAMP)
	rm -f examples/bench/campaign.toml examples/bench/measurements.csv examples/bench.sealed.json
	$(PYTHON) -m pipeline simulate examples/bench --effect joint_friction=800 --seed 2

clean:
	rm -rf $(VENV) .parastiff
