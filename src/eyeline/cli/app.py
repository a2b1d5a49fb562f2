"""The table of commands."""

from __future__ import annotations

import sys

import typer

from eyeline.cli.compare import compare
from eyeline.cli.convert import convert
from eyeline.cli.demo import demo
from eyeline.cli.doctor import doctor
from eyeline.cli.draw import draw
from eyeline.cli.explain import explain
from eyeline.cli.expose import expose
from eyeline.cli.info import info
from eyeline.cli.render import render

app = typer.Typer(
    name="eyeline",
    help="3D animation that knows what the viewer sees: pictures, films and data without a GPU.",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode="rich" if sys.stdout is not None and sys.stdout.isatty() else None,  # plain in a pipe
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)

for command in (render, draw, expose, convert, compare, explain, info, doctor, demo):
    app.command()(command)


def version(wanted: bool) -> None:
    """Print the version and stop."""
    if wanted:
        import eyeline

        print(f"eyeline {eyeline.__version__}")
        raise typer.Exit


@app.callback()
def common(
    version_wanted: bool = typer.Option(
        False, "--version", help="Print the version.", callback=version, is_eager=True
    ),
) -> None:
    """3D animation that knows what the viewer sees: pictures, films and data without a GPU."""
