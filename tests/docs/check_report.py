"""Reports against their JSON Schema, and reports that were broken against it.

    check_report.py SCHEMA REPORT...

A file may hold several reports one after another, as `faceprobe estimate --json` prints them. Fields that the schema does not know are allowed to
readers of reports, but not here: what is written stands in the schema. Of each report every field that the schema requires is then taken away, and
every value replaced by one of another type: the schema has to say no each time. Ends with 77 without python3-jsonschema.
"""

import copy
import json
import sys

try:
    from jsonschema import Draft202012Validator
except ImportError:
    print("there is no python3-jsonschema (Debian), 4.0 or later")
    sys.exit(77)

LEAST_FIELDS = 40  # of a report; fewer: its fields are no longer found


def closed(schema):
    """The same schema, for objects without other fields. What stands beside others in an allOf only narrows them and stays open."""
    if isinstance(schema, list):
        return [closed(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    shut = {name: part if name == "allOf" else closed(part) for name, part in schema.items()}
    if schema.get("type") == "object" and "required" in schema and "if" not in schema:
        shut["additionalProperties"] = False
    return shut


def reports_in(path):
    text = open(path, encoding="utf-8").read().strip()
    while text:
        report, end = json.JSONDecoder().raw_decode(text)
        yield report
        text = text[end:].lstrip()


def paths(value, way=()):
    """The way to every field of every object, the first items of lists standing for all."""
    if isinstance(value, dict):
        for name, item in value.items():
            yield (*way, name)
            yield from paths(item, (*way, name))
    elif isinstance(value, list) and value:
        yield from paths(value[0], (*way, 0))


def broken(report, way, value=None, drop=False):
    other = copy.deepcopy(report)
    holder = other
    for step in way[:-1]:
        holder = holder[step]
    if drop:
        del holder[way[-1]]
    else:
        holder[way[-1]] = value
    return other


def check(validator, report, name):
    for error in validator.iter_errors(report):
        yield f"{name}: {error.json_path}: {error.message[:200]}"
    found = list(paths(report))
    if len(found) < LEAST_FIELDS:
        yield f"{name}: only {len(found)} fields were found"
    for way in found:
        where = ".".join(map(str, way))
        if way != ("joint_light",) and validator.is_valid(broken(report, way, drop=True)):
            yield f"{name}: a report without {where} passes"
        # No field holds an object with this name in it.
        if validator.is_valid(broken(report, way, value={"no such field": 1})):
            yield f"{name}: a report with an object for {where} passes"
    if validator.is_valid({**report, "unknown": 1}):
        yield f"{name}: an unknown field passes"


def main(schema_file, files):
    schema = json.load(open(schema_file, encoding="utf-8"))
    Draft202012Validator.check_schema(schema)
    validator, open_one = Draft202012Validator(closed(schema)), Draft202012Validator(schema)
    problems, count = [], 0
    for file in files:
        for report in reports_in(file):
            count += 1
            problems += check(validator, report, file)
            if not open_one.is_valid({**report, "unknown": 1}):
                problems.append(f"{file}: readers have to accept fields that were added later")
    print(*problems, sep="\n")
    print(f"{count} reports, {len(problems)} problems")
    sys.exit(bool(problems) or not count)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
