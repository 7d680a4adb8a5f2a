"""`python -m pipeline`."""

from pipeline.cli import app
from pipeline.memory import keep_freed
from pipeline.threads import BLAS, one_thread

if __name__ == "__main__":
    one_thread((BLAS,))
    keep_freed()
    app(prog_name="pipeline")
