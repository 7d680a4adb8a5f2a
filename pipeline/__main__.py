"""`python -m pipeline`."""

from pipeline.cli import app
from pipeline.memory import keep_freed
from pipeline.processors import available, may_use
from pipeline.threads import BLAS, one_thread

if __name__ == "__main__":
    one_thread((BLAS,))
    keep_freed()
    may_use(available())
    app(prog_name="pipeline")
