"""The parsers of the commands about linkages and other machines with sizes. Nothing heavy is imported."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

__all__ = ["add_linkage_commands"]

_Commands = Any  # argparse's own type of a parser's commands is private


def add_linkage_commands(commands: _Commands) -> None:
    """Add them to the parser of all commands."""
    _add_analyse(commands)
    _add_grashof(commands)
    _add_realise(commands)
    _add_gears(commands)
    _add_cam(commands)
    _add_geneva(commands)
    _add_cognates(commands)
    _add_straight(commands)
    _add_draw(commands)
    _add_animate(commands)
    _add_gallery(commands)


def _add_analyse(commands: _Commands) -> None:
    analyse = commands.add_parser(
        "analyse",
        help="what a linkage does: dead centres, stroke, times, transmission angle, then poses and rates",
        description="Measures of a linkage with one drive, then a table of poses, rates and transmission angles; of "
        "several drives the table.",
        epilog="Examples: gruebler analyse four-bar:25,70,40,70 --speed 60; gruebler analyse lambda --point C "
        "--drive 90:270:10. Exit status: 0 all well, 1 it cannot be assembled or not be moved all the way, 2 wrong "
        "usage or unreadable input.",
    )
    analyse.add_argument(
        "linkage",
        metavar="FILE|ID|LENGTHS",
        help="a .toml or .json file, the id of a catalog entry with dimensions, or four-bar:A,B,C,D, "
        "slider-crank:A,B[,E], inverted-slider-crank:A,D[,E]",
    )
    analyse.add_argument(
        "--drive",
        action="append",
        default=[],
        metavar="FROM:TO:STEP",
        help="rows of the table, in degrees or the unit; for several drives once each, one number holds a drive still "
        "(default: a full turn by 15 degrees, or the whole range)",
    )
    analyse.add_argument("--at", action="append", type=float, default=[], metavar="VALUE", help="one row only")
    analyse.add_argument(
        "--speed",
        action="append",
        type=float,
        default=[],
        metavar="N",
        help="turns a minute; of a slide, lengths a second; of several drives once each",
    )
    for option, unit, order in (("--acceleration", "s²", "second"), ("--jerk", "s³", "third")):
        analyse.add_argument(
            option,
            action="append",
            type=float,
            default=[],
            metavar="A" if order == "second" else "J",
            help=f"with --speed: radians per {unit}; of a slide, lengths per {unit}; of several drives once each"
            + ("; rates of the third order are told too" if order == "third" else ""),
        )
    analyse.add_argument("--branch", metavar="B", help="the assembly mode, such as + or +-; write --branch=- for minus")
    analyse.add_argument(
        "--point", action="append", default=[], metavar="K", help="a named point, a joint, or LINK:X,Y; repeatable"
    )
    analyse.add_argument("--output", action="append", default=[], metavar="LINK", help="the link looked at; repeatable")
    analyse.add_argument(
        "--poles", action="store_true", help="the instant centres of all pairs of links; with --at a list"
    )
    analyse.add_argument(
        "--curvature", action="store_true", help="radius and centre of curvature of each --point; inflection circles"
    )
    analyse.add_argument("--json", action="store_true", help="an object with linkage, measures, columns and rows")
    analyse.add_argument("-o", dest="csv", type=Path, metavar="FILE", help="the table as CSV, units in its header")
    _finish(analyse, "analyse")


def _add_grashof(commands: _Commands) -> None:
    grashof = commands.add_parser(
        "grashof",
        help="the type of a four-bar, which links turn fully, and for which lengths",
        description="Crank A, coupler B, rocker C, frame D: type, links that turn fully, limits, swing, transmission "
        "angle. With --free: the types (with --turns: only where that link turns fully) along one length, the others "
        "given in order.",
        epilog="Exit status: 0 yes, 1 not assemblable, the link does not turn or no value lets it, 2 wrong usage. "
        "Example: gruebler grashof 25 40 70 --free d --turns a",
    )
    grashof.add_argument(
        "lengths", nargs="+", metavar="LENGTH", help="A B C D; with --free the other three, or all four"
    )
    grashof.add_argument("--free", choices=("a", "b", "c", "d"), help="go through the values of this length")
    grashof.add_argument(
        "--turns", choices=("a", "b", "c"), metavar="LINK", help="a, b or c: does it turn fully against the frame"
    )
    grashof.add_argument("--json", action="store_true", help="one object; with --free its items")
    _finish(grashof, "grashof")


def _add_realise(commands: _Commands) -> None:
    realise = commands.add_parser(
        "realise",
        help="find dimensions with which a mechanism moves",
        description="Dimensions with which the mechanism assembles and its drives turn fully, or move over a wide "
        "range. Without a drive: turning joints at the frame if possible.",
        epilog="Exit status: 0 found, 1 none found or nothing to be moved, 2 wrong usage or unreadable input.",
    )
    realise.add_argument("chain", metavar="CHAIN", help="a text, a code, g6:CODE or the id of a catalog entry")
    realise.add_argument("--frame", metavar="LINK", help="the link that stands still (default: the first)")
    realise.add_argument("--drive", action="append", default=[], metavar="JOINT", help="a driven joint; repeatable")
    realise.add_argument("--seed", type=int, default=0, metavar="S", help="of the random numbers (default: 0)")
    realise.add_argument("--tries", type=int, default=1500, metavar="N", help="drawings a search tries (default: 1500)")
    realise.add_argument("-o", "--output", type=Path, metavar="FILE", help="a .toml or .json file for the linkage")
    realise.add_argument("--json", action="store_true", help="an object with the linkage, ranges and quality")
    _finish(realise, "realise")


def _add_gears(commands: _Commands) -> None:
    gears = commands.add_parser(
        "gears",
        help="speeds, ratios, torques and power of a gear train",
        description="Speeds of all links of a gear train from one linear system (Willis), exact; torques by virtual "
        "work. A wheel is LINK:TEETH (or a radius), minus for internal toothing; wheels in a row mesh in turn; "
        "'on ARM' names the carrier of their axes. Other kinds: belt, chain, crossed, friction, bevel, rack, screw, "
        "winch. Then drive LINK=SPEED, hold LINK, load LINK=TORQUE; planets=N asks whether so many can be put in.",
        epilog="Example: gruebler gears 'sun:24 planet:18 ring:-60 on arm planets=3; hold ring; drive sun=1000; "
        "load arm=-50'; with -o train.html --animate --teeth it moves. Exit status: 0 determined (or nothing driven), "
        "1 undetermined, contradicted or not to be assembled, 2 wrong usage or unreadable input.",
    )
    gears.add_argument("train", metavar="TRAIN|FILE", help="a text, a file of statements (.txt) or a table (.toml)")
    gears.add_argument("--json", action="store_true", help="an object; numbers as exact fractions and decimals")
    gears.add_argument("--teeth", action="store_true", help="with -o: involute teeth instead of pitch circles")
    _add_picture(gears, "a turn of the fastest link")
    _finish(gears, "gears")


def _add_cam(commands: _Commands) -> None:
    cam = commands.add_parser(
        "cam",
        help="a cam for a lift: profile, pressure angle, curvature, undercut; or what a given contour does",
        description="A disc cam that turns counter-clockwise. LIFT is a row of 'rise LIFT ANGLE [LAW]', 'fall LIFT "
        "ANGLE [LAW]', 'dwell [ANGLE]' with angles in degrees (the lift of a swinging follower too); instead of a law "
        "boundary values per radian, such as v0=0 a0=0 v1=5 a1=0. Rates are told per radian of the cam.",
        epilog="Example: gruebler cam 'rise 20 60 3-4-5; dwell 30; fall 20 90 cycloidal; dwell' --base 40 --roller 10 "
        "-o cam.svg --plot. Exit status: 0 good, 1 undercut, 2 wrong usage or unreadable input.",
    )
    cam.add_argument("lift", nargs="?", metavar="LIFT", help="the lift over a turn; one dwell may take the rest")
    cam.add_argument("--laws", action="store_true", help="the laws of motion with C_v, C_a, C_j")
    cam.add_argument("--contour", metavar="FILE", help="points x y of a given contour, one a line: the motion it gives")
    cam.add_argument("--base", type=float, metavar="R", help="radius of the base circle")
    cam.add_argument("--roller", type=float, metavar="R", help="a roller with this radius")
    cam.add_argument("--knife", action="store_true", help="a knife edge")
    cam.add_argument(
        "--flat", type=float, nargs="?", const=0.0, metavar="E", help="a flat face; E: how far from its pivot"
    )
    cam.add_argument("--offset", type=float, default=0.0, metavar="E", help="the guide lies so far right of the axis")
    cam.add_argument(
        "--swing", type=float, nargs=2, metavar=("ARM", "D"), help="arm length (0 for a face) and distance of the pivot"
    )
    cam.add_argument("--step", type=float, metavar="DEG", help="a table of the turn in such steps")
    cam.add_argument("--json", action="store_true", help="as JSON")
    cam.add_argument(
        "--at", type=float, metavar="DEG", help="with -o: the cam's angle (default: greatest pressure angle)"
    )
    cam.add_argument("--plot", action="store_true", help="with -o: lift, velocity and acceleration beneath")
    _add_picture(cam, "a turn")
    _finish(cam, "cam")


def _add_geneva(commands: _Commands) -> None:
    geneva = commands.add_parser(
        "geneva",
        help="a Geneva drive: dwell, ratio, acceleration",
        description="A Geneva drive with radial slots that the pins enter without a blow.",
        epilog="Examples: gruebler geneva 4 --distance 100 --speed 60 --step 15; gruebler geneva 6 --pins 2 --animate "
        "-o geneva.html. PNG, PDF, GIF and WebP need matplotlib: pip install 'gruebler[plot]'.",
    )
    geneva.add_argument("slots", type=int, metavar="N", help="number of slots, at least 3")
    geneva.add_argument("--internal", action="store_true", help="the driver turns inside the wheel")
    geneva.add_argument("--pins", type=int, default=1, metavar="K", help="pins on the driver (default: 1)")
    geneva.add_argument("--distance", type=float, metavar="D", help="distance of the axes: lengths are told")
    geneva.add_argument("--speed", type=float, metavar="RPM", help="of the driver, turns a minute: times are told")
    geneva.add_argument("--step", type=float, metavar="DEG", help="a table of the driver's turn in such steps")
    geneva.add_argument("--json", action="store_true", help="as JSON")
    geneva.add_argument("--at", type=float, metavar="DEG", help="with -o: the driver's angle (default: 0)")
    geneva.add_argument("--plot", action="store_true", help="with -o: angle, ratio and acceleration beneath")
    _add_picture(geneva, "a turn")
    _finish(geneva, "geneva")


def _add_picture(machine: argparse.ArgumentParser, time: str) -> None:
    """Options for the picture of a machine, besides its table."""
    machine.add_argument("-o", "--output", type=Path, metavar="FILE", help="also a picture: .svg, .png or .pdf")
    machine.add_argument(
        "--animate", action="store_true", help="with -o: moving, as .svg, .html, .gif, .webp or .png (APNG)"
    )
    machine.add_argument("--seconds", type=float, metavar="S", help=f"with --animate: for {time} (default: 4)")
    machine.add_argument("--dark", action="store_true", help="with -o: pictures and PDF on dark ground")


def _add_cognates(commands: _Commands) -> None:
    cognates = commands.add_parser(
        "cognates",
        help="the other linkages that trace the same coupler curve (Roberts, Chebyshev)",
        description="The three cognates of a four-bar with a coupler point, or the two of a slider-crank: lengths, "
        "coupler point, where they stand (A0 = 0, B0 on the x axis), which links turn with which.",
        epilog="Example: gruebler cognates 25,70,40,70 45,40; gruebler cognates slider-crank:25,70,10 35,40. "
        "A point with a negative U is written after two dashes: gruebler cognates 25,70,40,70 -- -10,40",
    )
    _add_coupler_point(cognates)
    cognates.add_argument("--at", type=float, metavar="DEG", help="crank angle of the pose that is told (home pose)")
    cognates.add_argument("--json", action="store_true", help="as JSON, with the pins of the pose")
    _finish(cognates, "cognates")


def _add_straight(commands: _Commands) -> None:
    straight = commands.add_parser(
        "straight",
        help="how straight a coupler curve is: relative deviation, longest piece in a band",
        description="The piece of a coupler curve symmetric about a crank angle that has a given relative deviation "
        "Q_G = deviation/length; the longest piece in a band; or length and band of a given piece.",
        epilog="Example: gruebler straight 20,50,50,40 100,0 --window 90 270 --direction 0; "
        "gruebler straight 20,50,50,40 100,0 --band 0.2. Exit status: 0, 1 no such piece, 2 wrong usage.",
    )
    _add_coupler_point(straight)
    straight.add_argument("--ratio", type=float, metavar="Q", help="the window about --centre with this Q_G")
    straight.add_argument("--band", type=float, metavar="WIDTH", help="the longest piece in a band of this width")
    straight.add_argument("--window", type=float, nargs=2, metavar=("FROM", "TO"), help="the piece between two angles")
    straight.add_argument("--centre", type=float, default=180.0, metavar="DEG", help="crank angle (default: 180)")
    straight.add_argument("--direction", type=float, metavar="DEG", help="of the line (default: tangent, best line)")
    straight.add_argument("--json", action="store_true", help="as JSON")
    _finish(straight, "straight")


def _add_coupler_point(command: argparse.ArgumentParser) -> None:
    command.add_argument("lengths", metavar="A,B,C,D", help="a four-bar; or slider-crank:A,B[,E]")
    command.add_argument("point", metavar="U,V", help="the coupler point: U along the coupler, V to its left")
    command.add_argument("--branch", type=int, choices=(1, -1), default=1, help="assembly branch (default: 1)")


def _add_path(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--drive",
        action="append",
        default=[],
        metavar="FROM:TO:STEP",
        help="a straight path of the drives, in degrees or the unit, for several drives once each with as many steps; "
        "one number holds a drive still (default: the whole motion of one drive)",
    )


def _add_draw(commands: _Commands) -> None:
    draw = commands.add_parser(
        "draw",
        help="draw a chain or a mechanism",
        description="The structure picture of a chain or mechanism: links as bodies, joints by their signs, the frame "
        "hatched, drives as arrows. With --pose, --curve, --show or --ghosts, or of a linkage: to scale.",
        epilog="Without -o the SVG goes to standard output. PNG and PDF need matplotlib: pip install 'gruebler[plot]'.",
    )
    draw.add_argument(
        "chain",
        metavar="CHAIN|ID|FILE",
        help="a text, a code, g6:CODE, the id of a catalog entry, the file of a linkage, or lengths such as "
        "four-bar:25,70,40,70",
    )
    draw.add_argument(
        "--pose",
        nargs="?",
        const="",
        metavar="VALUE[,VALUE]",
        help="to scale, at this drive value (degrees, or a way; --pose=-30,20 for several drives); alone: a good pose",
    )
    draw.add_argument(
        "--curve", action="append", default=[], metavar="POINT", help="the path of a point or joint; repeatable"
    )
    draw.add_argument(
        "--show",
        action="append",
        default=[],
        choices=(
            "dead-centres",
            "transmission",
            "velocities",
            "accelerations",
            "poles",
            "centrodes",
            "inflection",
            "dimensions",
            "scale",
        ),
        help="also show this; repeatable",
    )
    draw.add_argument("--ghosts", type=int, metavar="N", help="so many other positions thinly, for print")
    draw.add_argument(
        "--of", metavar="LINK", help="the link whose dead centres, transmission angle, centrodes, ... are shown"
    )
    draw.add_argument("--branch", metavar="LABELS", help="the assembly mode, such as +- (write --branch=-+)")
    draw.add_argument("-o", "--output", type=Path, metavar="FILE", help="a file .svg, .png or .pdf")
    draw.add_argument("--space", choices=("planar", "spherical", "spatial"), help="where a text lives")
    draw.add_argument("--frame", metavar="LINK", help="the link that stands still")
    draw.add_argument("--drive", action="append", default=[], metavar="JOINT", help="a driven joint; repeatable")
    draw.add_argument("--labels", action="store_true", help="name the links")
    draw.add_argument("--dark", action="store_true", help="PNG and PDF on dark ground; an SVG is on the reader's")
    view = draw.add_mutually_exclusive_group()
    view.add_argument("--graph", action="store_true", help="the link graph instead")
    view.add_argument("--contracted", action="store_true", help="the contracted graph instead")
    view.add_argument("--loops", action="store_true", help="mark the independent loops")
    _finish(draw, "draw")


def _add_animate(commands: _Commands) -> None:
    animate = commands.add_parser(
        "animate",
        help="a linkage that moves by itself: SVG, an HTML page with a slider, GIF, WebP, APNG",
        description="A full turn of the drive, or to and fro where it has limits, over and over. SVG without script; "
        "one HTML page with play, pause and a slider for the drive; pictures as .gif, .webp or .png (APNG).",
        epilog="Example: gruebler animate wiper -o wiper.html --seconds 3. Without -o the SVG goes to standard output. "
        "GIF, WebP and PNG need matplotlib: pip install 'gruebler[plot]'.",
    )
    animate.add_argument(
        "linkage", metavar="FILE|ID", help="a file, a catalog entry, or lengths such as four-bar:25,70,40,70"
    )
    animate.add_argument(
        "-o", "--output", type=Path, metavar="FILE", help="a file .svg, .html, .gif, .webp or .png (APNG)"
    )
    animate.add_argument(
        "--curve", action="append", default=[], metavar="POINT", help="the path of a point or joint; repeatable"
    )
    animate.add_argument(
        "--seconds", type=float, default=4.0, metavar="S", help="for a turn, or for there and back (default: 4)"
    )
    animate.add_argument("--branch", metavar="LABELS", help="the assembly mode, such as +-")
    _add_path(animate)
    animate.add_argument("--dark", action="store_true", help="GIF, WebP and PNG on dark ground")
    _finish(animate, "animate")


def _add_gallery(commands: _Commands) -> None:
    gallery = commands.add_parser(
        "gallery",
        help="draw all chains or mechanisms of a request on one page",
        description="All chains of a request, or machines of the catalog, on one page.",
        epilog="Examples: gruebler gallery --links 8 -o eight.html; gruebler variants --links 6 --prismatic 1 | "
        "gruebler gallery - -o sliders.html. PDF needs matplotlib: pip install 'gruebler[plot]'.",
    )
    gallery.add_argument(
        "ids",
        nargs="*",
        metavar="ID|CHAIN|FILE|-",
        help="instead of a request: entries of the catalog, texts of chains and mechanisms, files with one a line, or "
        "- for lines on standard input",
    )
    gallery.add_argument("--links", type=int, metavar="N", help="number of links")
    gallery.add_argument("--mobility", type=int, metavar="F", help="mobility (default: 1)")
    gallery.add_argument(
        "--fractionated", choices=("none", "link", "joint", "all"), help="as for enumerate (default: none)"
    )
    gallery.add_argument("--assortment", metavar="N2,N3,...", help="numbers of binary, ternary, ... links")
    gallery.add_argument("--multiple-joints", metavar="K|any", help="as for enumerate (default: 0)")
    gallery.add_argument("--inversions", action="store_true", help="each chain with every frame that matters")
    gallery.add_argument("--labels", action="store_true", help="name the links")
    gallery.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help="a file .html or .pdf")
    _finish(gallery, "gallery")


def _finish(parser: argparse.ArgumentParser, module: str) -> None:
    parser.add_argument("--lang", choices=("en", "de"), default="en", help="language of the answer (default: en)")
    parser.set_defaults(run=f"gruebler.cli.{module}")
