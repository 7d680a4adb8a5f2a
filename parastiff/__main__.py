"""`parastiff`, and `python -m parastiff`."""

from pipeline.__main__ import main

if __name__ == "__main__":
    main()
