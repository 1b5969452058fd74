import marimo

__generated_with = "0.25.2"
app = marimo.App()


@app.cell
def _():
    import marimo as mo

    return (mo,)


@app.cell(hide_code=True)
def _(mo):
    mo.md(r"""
    # A spinning top, from its Lagrangian to a trajectory

    A cone of height `h` and radius `R` spins on its apex. `derive` goes from its Lagrangian to the equations of motion, checks every step, and hands them on as formulas, as SymPy expressions and as compiled code. First the equations; the steps are folded below them.
    """)
    return


@app.cell
def _():
    from derive import SO, Gravity, Problem, Solid, compile, derive

    upside_down = {"axis": [1, 0, 0], "angle": "pi"}
    cone = Solid("cone", "rho", radius="R", height="h", rotation=upside_down, shift=[0, 0, "h"])
    top = Problem(
        "cone",
        SO(3),
        cone,
        Gravity(0, 0, "-g"),
        parameters={
            "rho": {"default": 1000, "unit": "kg/m^3"},
            "R": {"default": 0.05, "unit": "m"},
            "h": {"default": 0.1, "unit": "m"},
            "g": {"default": 9.81, "unit": "m/s^2"},
        },
        title="A cone on its apex",
    )
    d = derive(top)
    d
    return compile, d, top


@app.cell(hide_code=True)
def _(mo):
    mo.md(r"""
    The body as it is drawn in the lecture notes:
    """)
    return


@app.cell
def _(d):
    d.figure()
    return


@app.cell(hide_code=True)
def _(mo):
    mo.md(r"""
    A step, as it stands in the lecture notes:
    """)
    return


@app.cell
def _(d):
    d["kernel"]
    return


@app.cell(hide_code=True)
def _(mo):
    mo.md(r"""
    One equation:
    """)
    return


@app.cell
def _(d):
    d["motion"].equations[-1]
    return


@app.cell(hide_code=True)
def _(mo):
    mo.md(r"""
    Every step is checked again by exact arithmetic, on another road:
    """)
    return


@app.cell
def _(d):
    d.check(seed=1)
    return


@app.cell(hide_code=True)
def _(mo):
    mo.md(r"""
    The rates of ζ in coordinates, as SymPy expressions in the parameters of the cone; its density is not in them.
    """)
    return


@app.cell
def _(d):
    import sympy

    e = d.expressions()
    e.rhs[9:, :].subs(e.k).applyfunc(sympy.factor)
    return


@app.cell(hide_code=True)
def _(mo):
    mo.md(r"""
    A motion, with what it keeps. **Change the spin**, in rad/s: at 400 the axis of the top nods a little, at 150 it swings far down and back, at 60 below the apex. Then run the cells below again.
    """)
    return


@app.cell
def _(d):
    spin, lean = 150, 0.3
    run = d.simulate(2, start={"zeta_3": spin}, exp=(lean, 0, 0))
    run
    return lean, spin


@app.cell
def _(d, lean, spin):
    d.motion_page(2, start={"zeta_3": spin}, exp=(lean, 0, 0))
    return


@app.cell(hide_code=True)
def _(mo):
    mo.md(r"""
    The same by the compiled code, in a solver of one's own:
    """)
    return


@app.cell
def _(compile, lean, spin, top):
    import numpy as np
    from scipy.integrate import solve_ivp

    c, s = np.cos(lean), np.sin(lean)
    A = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    x0 = np.r_[A.ravel(), 0, 0, spin]
    f = compile(top)
    found = solve_ivp(f, (0, 2), x0, rtol=1e-10, atol=1e-10)
    height = found.y[8]  # the last entry of A: the cosine of the angle with the vertical
    drift = f.energy(2, found.y[:, -1]) / f.energy(0, x0) - 1
    print(f"{height.min():.3f} {height.max():.3f} {drift:.1e}")
    return


if __name__ == "__main__":
    app.run()
