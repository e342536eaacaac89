"""JUnit XML as Jenkins' schema (junit-10.xsd) allows it: which elements, in which elements, with which attributes."""

import math
import re
from xml.etree import ElementTree

import pytest

from albedo_lab.analysis.verdict import Finding, Verdict
from albedo_lab.report.findings import findings_text
from albedo_lab.report.junit import Case, junit_xml

COUNT, TEXT, TIME = r"\d+", r"[\s\S]*", r"\d+(\.\d+)?"
SCHEMA = {
    "testsuites": ({"name": TEXT, "tests": COUNT, "failures": COUNT, "errors": COUNT, "time": TIME}, {"testsuite"}),
    "testsuite": (
        {"name": TEXT, "tests": COUNT, "failures": COUNT, "errors": COUNT, "skipped": COUNT, "time": TIME},
        {"testcase"},
    ),
    "testcase": ({"classname": TEXT, "name": TEXT, "time": TIME}, {"failure", "error", "skipped", "system-out"}),
    "failure": ({"type": TEXT, "message": TEXT}, set()),
    "error": ({"type": TEXT, "message": TEXT}, set()),
    "skipped": ({"type": TEXT, "message": TEXT}, set()),
    "system-out": ({}, set()),
}
"""Of every element: its attributes with their patterns, and what may stand in it. Only testsuite and testcase repeat."""
REPEATED = {"testsuite", "testcase"}
OF_VERDICT = {
    Verdict.PASS: "system-out",
    Verdict.REPORTED: "system-out",
    Verdict.FAIL: "failure",
    Verdict.INCONCLUSIVE: "error",
    Verdict.SKIPPED: "skipped",
}


def validate(element):
    """Raises AssertionError for what the schema does not allow, and for counts that do not count."""
    attributes, children = SCHEMA[element.tag]
    assert set(element.attrib) == set(attributes)
    assert all(re.fullmatch(attributes[name], text) for name, text in element.attrib.items())
    tags = [child.tag for child in element]
    assert set(tags) <= children
    assert len(tags) == len(set(tags)) or set(tags) <= REPEATED
    cases = list(element.iter("testcase"))
    for name, tag in (("tests", None), ("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
        if name in element.attrib:
            assert int(element.get(name)) == (len(cases) if tag is None else len(list(element.iter(tag))))
    if element.tag == "testsuite":
        names = [case.get("name") for case in cases]
        assert len(names) == len(set(names))
    for child in element:
        validate(child)


def case(verdict, check="energy", model="phong", parameters="n=1", **more):
    return Case(model, parameters, Finding(check, verdict, 1.5, 1.0, "says", **more))


def parsed(cases):
    text = junit_xml(cases)
    assert text.startswith('<?xml version="1.0" encoding="UTF-8"?>\n')
    assert text.endswith("</testsuites>\n") or not cases
    root = ElementTree.fromstring(text.encode())
    validate(root)
    return root


def test_every_verdict_has_its_element():
    root = parsed([case(verdict) for verdict in OF_VERDICT])
    assert [[child.tag for child in element] for element in root.iter("testcase")] == [[tag] for tag in OF_VERDICT.values()]
    assert root.attrib == {"name": "albedo-lab check", "tests": "5", "failures": "1", "errors": "1", "time": "0"}
    assert root.find("testsuite").get("skipped") == "1"


def test_the_validator_sees_what_is_wrong():
    """Negative control: a count that does not count, an unknown attribute, an element out of place, a name twice."""
    for spoil in (
        lambda root: root.set("tests", "7"),
        lambda root: root.find("testsuite").set("speed", "1"),
        lambda root: ElementTree.SubElement(root, "testcase", classname="a", name="b", time="0"),
        lambda root: root.find("testsuite")[1].set("name", root.find("testsuite")[0].get("name")),
        lambda root: root.find("testsuite").set("time", "soon"),
    ):
        root = parsed([case(Verdict.PASS), case(Verdict.FAIL)])
        spoil(root)
        with pytest.raises(AssertionError):
            validate(root)


def test_a_suite_per_model_and_parameters():
    root = parsed([case(Verdict.PASS, parameters=p, model=m) for p in ("n=1", "n=2") for m in ("phong", "blinn")] * 2)
    assert [suite.get("name") for suite in root] == ["phong n=1", "blinn n=1", "phong n=2", "blinn n=2"]
    assert [element.get("name") for element in root[0]] == ["energy 1, n=1", "energy 2, n=1"]
    assert root[0][0].get("classname") == "albedo_lab.phong"
    assert parsed([case(Verdict.PASS, parameters="")])[0][0].get("name") == "energy"


def test_all_that_is_known_stands_in_the_failure():
    root = parsed([case(Verdict.FAIL, witness="mu = 1", claim="eq. 3", p_value=1e-9)])
    failure = next(root.iter("failure"))
    assert failure.get("message") == "says"
    assert failure.text.splitlines() == [
        "found: says",
        "claimed: eq. 3",
        "witness: mu = 1",
        "figure: 1.5",
        "threshold: 1.0",
        "p-value: 1e-09",
    ]
    told = Finding("grazing", Verdict.REPORTED, math.nan, math.nan, "nothing")
    assert next(parsed([Case("a", "", told)]).iter("system-out")).text == "found: nothing"


@pytest.mark.parametrize(
    "text", ['<b> & "quoted" \']]>', "bell \x07, null \x00, escape \x1b[31m", "\ud800", "\ufffe", "ß∫𝛼\tx\ny"]
)
def test_any_text_is_well_formed(text):
    """What XML cannot hold is told as Python would write it; all else comes back as it was."""
    root = parsed([Case(text, text, Finding(text, Verdict.FAIL, 1.0, 1.0, text, witness=text, claim=text))])
    failure = next(root.iter("failure"))
    plain = re.sub("[\x00-\x08\x1b\ud800\ufffe]", lambda found: ascii(found[0])[1:-1], text)
    assert f"found: {plain}" in failure.text
    assert failure.get("message") == plain


def test_without_cases():
    assert parsed([]).get("tests") == "0"


def test_equal_runs_give_equal_text():
    cases = [case(verdict) for verdict in OF_VERDICT]
    assert junit_xml(cases) == junit_xml(list(cases))


def test_the_table_for_a_person():
    cases = [
        case(Verdict.PASS),
        Case("phong", "n=1", Finding("sampler", Verdict.PASS, 1.0, math.nan, "far", p_value=0.9)),
        Case("phong", "n=1", Finding("sampler", Verdict.PASS, 2.0, math.nan, "near", p_value=0.04)),
        Case("phong", "n=1", Finding("sampler", Verdict.FAIL, 3.0, math.nan, "off", p_value=1e-9, witness="there")),
        Case("blinn", "", Finding("claims", Verdict.PASS, math.nan, math.nan, "is so", claim="must\nbe so")),
        Case("ward", "", Finding("claims", Verdict.INCONCLUSIVE, math.nan, math.nan, "no time")),
    ]
    assert findings_text(cases) == (
        "model  parameters  check    verdict       figure  limit  p      found\n"
        "phong  n=1         energy   PASS          1.5     1             says\n"
        "phong  n=1         sampler  PASS          2              0.04   nearest of 2 tests: near\n"
        "phong  n=1         sampler  FAIL          3              1e-09  off; witness: there\n"
        "blinn              claims   PASS                                claimed: must be so; found: is so\n"
        "ward               claims   INCONCLUSIVE                        no time\n"
        "\n"
        "phong  FAIL          3 passed, 1 failed: sampler\n"
        "blinn  PASS          1 passed\n"
        "ward   INCONCLUSIVE  1 inconclusive: claims\n"
    )
    coloured = findings_text(cases, coloured=True)
    assert "\x1b[31mFAIL" in coloured
    assert re.sub("\x1b\\[\\d+m", "", coloured) == findings_text(cases)


def test_long_lines_go_on_below():
    told = [Case("phong", "", Finding("energy", Verdict.PASS, 1.0, 1.0, "word " * 60))]
    text = findings_text(told, width=90)
    table = text.partition("\n\n")[0].splitlines()
    assert max(map(len, table)) <= 90
    assert len(table) > 5
    assert {line.index("word") for line in table[1:]} == {table[0].index("found")}
