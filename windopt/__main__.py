"""``python -m windopt``: the command line."""

from windopt.cli import main

if __name__ == "__main__":
    main()
