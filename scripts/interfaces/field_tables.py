"""The section "Fields" of docs/interface.md: one table for each type of graspd_msgs."""

import ros

BEGIN = "<!-- fields: begin -->"
END = "<!-- fields: end -->"
INTRODUCTION = ("Written by `python3 scripts/interfaces docs` from `idl/graspd.idl`. `[]` is a sequence, "
                "`[<=N]` one of at most N elements,\n`[N]` an array. The same comments stand in the "
                "files of `idl/graspd_msgs`.")


def cell(text):
    return " ".join(text.split()).replace("|", "\\|").replace("<", "\\<")


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows]


def message_lines(message):
    title = message.name.replace("_", " ") if message.folder == "srv" else message.name
    lines = [f"### {title}", ""]
    for paragraph in ros.paragraphs(message.comment):
        lines += [paragraph.replace("<", "\\<"), ""]
    if message.constants:
        lines += table(("constant", "value", "meaning"),
                       [(f"`{name}`", str(value), cell(comment))
                        for _, name, value, comment in message.constants]) + [""]
    rows = [(f"`{field.name}`", f"`{field.type_text(ros.PACKAGE)}`", cell(field.comment))
            for field in message.fields]
    return lines + table(("field", "type", "meaning"), rows) + [""]


def section(messages):
    """The lines between the two marks."""
    lines = [INTRODUCTION, ""]
    for message in messages:
        if message.package == ros.PACKAGE:
            lines += message_lines(message)
    return "\n".join(lines)


def updated(document, messages):
    """The document with its section replaced, or appended where it has none."""
    if BEGIN not in document:
        document = document.rstrip("\n") + f"\n\n## Fields\n\n{BEGIN}\n{END}\n"
    before, rest = document.split(BEGIN, 1)
    after = rest.split(END, 1)[1]
    return f"{before}{BEGIN}\n{section(messages)}{END}{after}"
