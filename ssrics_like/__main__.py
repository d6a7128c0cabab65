"""The command ``ssrics``, also as ``python -m ssrics_like``: an interrupt shows no traceback.

Nothing is imported up here, or an interrupt would meet the imports unprepared.
"""


def main() -> None:
    """Run the command line; an interrupt before or after it ends the program at once."""
    import os  # noqa: PLC0415 - see above
    import signal  # noqa: PLC0415

    interrupted = False

    def stop(*_: object) -> None:
        nonlocal interrupted
        interrupted = True
        raise KeyboardInterrupt

    def leave(*_: object) -> None:
        try:
            os.write(2, b"ssrics: interrupted\n")
        finally:  # also where nobody reads it
            os._exit(INTERRUPTED)

    # A program in the background of a shell ignores interrupts, and goes on doing so.
    interruptible = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if interruptible:
        signal.signal(signal.SIGINT, leave)
    from ssrics_like.cli import main as run  # noqa: PLC0415

    try:
        if interruptible:
            signal.signal(signal.SIGINT, stop)
        run()
    except Exception:
        # Libraries make errors of their own of an interrupt that meets them amid being imported.
        if not interrupted:
            raise
        leave()
    except KeyboardInterrupt:
        leave()
    finally:
        if interruptible:
            signal.signal(signal.SIGINT, leave)


INTERRUPTED = 130  # as of a shell: 128 and the number of the signal

if __name__ == "__main__":
    main()
