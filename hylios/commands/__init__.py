"""The subcommands of `hylios`, one module each: arguments in, text or a file out.

Each imports what it computes with only when it runs, so that `hylios tan` needs no numba.
"""
