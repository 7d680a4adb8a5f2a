"""`python -m pipeline`."""

from pipeline.cli import app
from pipeline.memory import keep_freed

if __name__ == "__main__":
    keep_freed()
    app(prog_name="pipeline")
