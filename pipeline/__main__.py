"""`python -m pipeline`."""

from pipeline.memory import keep_freed
from pipeline.processors import available, may_use
from pipeline.threads import BLAS, one_thread
from pipeline.typed import program


def main() -> None:
    """The command line as it was typed."""
    one_thread((BLAS,))
    keep_freed()
    may_use(available())
    from pipeline.cli import app

    app(prog_name=program())


if __name__ == "__main__":
    main()
