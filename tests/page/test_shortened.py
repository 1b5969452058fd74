"""The script of a page in few characters does what it did."""

import pytest

from derive.code.emit import emit
from derive.code.options import Options
from derive.page.shortened import called, shortened
from derive.pipeline import motion_of
from tests.support.in_node import printed
from tests.support.motion_pages import page, told
from tests.support.walks import derived


def test_a_shortened_module_does_the_same():
    d, of_page = derived("sl3"), told(page("sl3"))
    code, names = motion_of(d.problem, d.record), ["begin", "gauss_to", "constants", "conserved"]
    chosen = Options(step="gauss", conserved=True)
    (source,) = emit(code.program, d.record, ("javascript",), "sl3", chosen).values()
    needed = called(source.replace("\nexport ", "\n"), names)
    whole = f"""
        const module = (() => {{ {needed} return {{ {", ".join(names)} }}; }})();
        const k = module.constants({of_page["p"]}), motion = module.begin(0, {of_page["x"]});
        module.gauss_to(motion, k, null, 3, 1e-9);
        console.log(JSON.stringify([...motion.x, ...module.conserved(3, motion.x, k)]));
    """
    assert printed(whole) == printed(shortened(whole))
    assert len(shortened(whole)) < 0.55 * len(whole)
    assert "dense" not in needed


HAND = {
    "const first = 1, a = 2; // one\nconst third = a - -first;\n": "const b=1,a=2,c=a- -b;",
    'f({ key: "a  b // c" }, `x ${long(key)}  y`);': 'f({key:"a  b // c"},`x ${long(key)}  y`);',
    "const long = 1; x.long = long; ++x.y;": "const a=1;x.long=a;++x.y;",
    "f(0.5, 2.0, 0.0, 10.05, 0, 1e-3, a ? 0.5 : true);": "f(.5,2,0,10.05,0,1e-3,a?.5:!0);",
    "f([1, , ], { a: 1, }, [, a], [1, 2,],);": "f([1,,],{a:1},[,a],[1,2]);",
    # an inner name may be that of an outer one which is not used within
    "const one = 1; const two = (x) => x + one; g((one) => one, two);": (
        "const a=1,b=b=>b+a;g(a=>a,b);"
    ),
    # keys stay, also of patterns, methods and getters
    "function f({ x, y: z = x }, ...more) { return { x, z: z, get more() { return more; } }; }": (
        "function a({x:a,y:c=a},...b){return{x:a,z:c,get more(){return b}}}"
    ),
    "for (const x of [1]) for (let y = x; y < 2; ++y) { const x = y; h(x); } x(y);": (
        "for(const a of[1])for(let b=a;b<2;++b){const a=b;h(a)}x(y);"
    ),
    "f((x, y) => (z) => x, () => 1); const g = (x) => { return (y) => y; };": (
        "f((a,b)=>b=>a,()=>1);const a=a=>{return a=>a};"
    ),
    "try { f(); } catch (fault) { const f = fault; g(f); }": "try{f()}catch(b){const a=b;g(a)}",
    # what is used often of the language has a name
    '"use strict"; const first = Math.abs(1);': '"use strict";const a=Math.abs(1);',
    '"use strict"; f(Math.abs(Math.cos(Math.sin(Math.exp(Math.PI)))), x.Math);': (
        '"use strict";const a=Math;f(a.abs(a.cos(a.sin(a.exp(a.PI)))),x.Math);'
    ),
}


@pytest.mark.parametrize("source", HAND)
def test_shortening_by_hand(source):
    assert shortened(source) == HAND[source]


@pytest.mark.parametrize("source", ["class A { }", "f(async () => 1);", "switch (x) { }"])
def test_what_is_not_read_is_told(source):
    with pytest.raises(ValueError, match=r"not read: (class|async|switch)"):
        shortened(source)


SCOPES = """
const out = [];
const value = 1, other = { value, twice: (value) => 2 * value, deep: { value: value + 1 } };
function outer(value, { inner = value + 1, list: [head, ...tail] }, last = inner) {
    let total = 0;
    const later = () => total + value;
    for (const [k, value] of tail.entries()) {
        const inner = k * value;
        total += inner ? inner : value;
    }
    for (let k = 0, end = 3; k < end; ++k) total += k;
    {
        const total = "hidden", all = [head, ...tail];
        const value = `${total} ${later()} {} ${all.map((x) => x + 1)}`;
        out.push(total, value);
    }
    try {
        throw { total: 7 };
    } catch ({ total: found }) {
        out.push(found, total);
    }
    const machine = {
        total,
        get last() { return last + total; },
        step(by = 1) { total += by; return { total, by }; },
        ["computed"]: (a, b = a) => (a > b ? a : b),
    };
    machine.step(); machine.step(value);
    out.push(machine.last, machine.total, machine.step(2).total, machine.computed(3), later());
    return typeof head === "number" && head in { 5: 1 } ? { head, tail } : null;
}
out.push(outer(3, { list: [5, 6, 7] }), outer(1, { inner: 4, list: ["a"] }, 9));
out.push(other.twice(21), other.value, other.deep.value, other?.deep?.value ?? 0);
out.push([1, 2, 3].reduce((value, other) => value * 10 + other, Number(value !== 1 ? 5 : 0)));
out.push(((value) => (other) => value - other)(5)(3), (() => ({ value: 1 }))().value);
console.log(JSON.stringify(out));
"""


def test_scopes_as_the_language_has_them():
    assert printed(SCOPES) == printed(shortened(SCOPES)) != ""
    assert len(shortened(SCOPES)) < 0.6 * len(SCOPES)
