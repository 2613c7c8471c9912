"""Writes FOLDER/index.html, the report of `phlux bench`, from the section files in FOLDER (bench/README.md).

    python3 report.py FOLDER

The page contains the charts as SVG and needs no other file and no network.
"""
import csv
import glob
import html
import json
import os
import re
import sys

MOST_ROWS = 200

STYLE = """
:root { color-scheme: light dark; --paper: #ffffff; --ink: #22272e; --muted: #5d6670; --line: #d5dade; --wash: #f1f4f7;
  --link: #1f66a8; }
@media (prefers-color-scheme: dark) { :root { --paper: #14181d; --ink: #e3e7eb; --muted: #a2acb6; --line: #363f48;
  --wash: #1c2229; --link: #62aaf0; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.5rem 1rem 4rem; max-width: 70rem; background: var(--paper); color: var(--ink);
  font: 1rem/1.5 system-ui, "DejaVu Sans", sans-serif; overflow-wrap: break-word; }
h1 { font-size: 1.7rem; margin: 0; }
h2 { font-size: 1.35rem; margin: 3rem 0 .6rem; padding-top: 1rem; border-top: 1px solid var(--line); }
h3 { font-size: 1.05rem; margin: 1.8rem 0 .4rem; }
p { max-width: 46rem; margin: .5rem 0; }
a { color: var(--link); }
nav { margin: .8rem 0; } nav a { margin-right: 1.2rem; white-space: nowrap; }
.muted, figcaption { color: var(--muted); font-size: .9rem; }
figure { margin: 1.6rem 0; } figcaption { max-width: 46rem; }
figcaption b { color: var(--ink); }
.scroll { overflow-x: auto; }
@media (max-width: 38rem) { figure .scroll::before { content: "scroll sideways \\2194"; position: sticky; left: 0;
  color: var(--muted); font-size: .8rem; } }
figure svg { display: block; width: 100%; min-width: 36rem; height: auto; }
table { border-collapse: collapse; font-size: .86rem; font-variant-numeric: tabular-nums; margin: .5rem 0; }
th, td { padding: .25rem .7rem .25rem 0; text-align: left; vertical-align: top; }
th { font-weight: 600; border-bottom: 1px solid var(--line); }
td { border-bottom: 1px solid var(--wash); }
@media (max-width: 60rem) { table { font-size: .78rem; } th, td { padding-right: .4rem; } }
.number { text-align: right; } td.number { white-space: nowrap; }
summary { cursor: pointer; color: var(--link); margin: .6rem 0; }
code { white-space: nowrap; }
code, pre { font-family: "DejaVu Sans Mono", monospace; font-size: .86rem; }
pre { background: var(--wash); padding: .7rem .9rem; overflow-x: auto; }
"""

# Forbids the browser to fetch anything.
POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"


def escape(value):
    return html.escape(str(value))


def paragraph(text):
    """Options of the command line are set as code."""
    return "<p>" + re.sub(r"(?<![\w-])(--[a-z][a-z-]*|-i [a-z]+)", r"<code>\g<0></code>", escape(text)) + "</p>"


def number_of(value):
    if isinstance(value, bool) or value is None:
        return None
    if isinstance(value, (int, float)):
        return float(value)
    try:
        return float(value)
    except ValueError:
        return None


def cell(value):
    """A table cell: four digits of a number, a dash for an empty value."""
    if value is None or value == "" or value != value:
        return '<td class="number">–</td>'
    number = number_of(value)
    if number is None:
        return f"<td>{escape(value)}</td>"
    whole = number == int(number) if abs(number) < 1e9 else False
    return f'<td class="number">{int(number) if whole else format(number, ".4g")}</td>'


def table(columns, rows, text_only=False):
    if text_only:
        cells, numeric = lambda value: f"<td>{escape(value)}</td>", [False] * len(columns)
    else:
        cells = cell
        numeric = [all(number_of(row[i]) is not None or row[i] in ("", None) for row in rows)
                   for i in range(len(columns))]
    head = "".join(f'<th{" class=number" if is_number else ""}>{escape(str(name).replace("_", " "))}</th>'
                   for name, is_number in zip(columns, numeric))
    body = "\n".join("<tr>" + "".join(cells(value) for value in row) + "</tr>" for row in rows)
    return f'<div class="scroll"><table><thead><tr>{head}</tr></thead>\n<tbody>{body}</tbody></table></div>'


def inline_svg(path, label, prefix):
    """The SVG as an element of the page; its ids get the prefix, so that they are unique in the page."""
    with open(path, encoding="utf-8") as file:
        svg = file.read()
    svg = svg[svg.index("<svg"):]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.S)
    svg = re.sub(r'\bid="', f'id="{prefix}', svg)
    svg = re.sub(r'(href="|url\()#', rf"\g<1>#{prefix}", svg)
    opening = re.match(r"<svg\b[^>]*>", svg).group()
    plain = re.sub(r'\s(width|height)="[^"]*"', "", opening)
    plain = plain.replace("<svg", f'<svg role="img" aria-label="{escape(label)}"', 1)
    return plain + svg[len(opening):]


def chart(folder, entry, prefix):
    path = os.path.join(folder, entry["svg"])
    if not os.path.exists(path):
        return f'<p class="muted">{escape(entry["svg"])} is not here.</p>'
    return (f'<figure><div class="scroll">{inline_svg(path, entry["title"], prefix)}</div>'
            f'<figcaption><b>{escape(entry["title"])}.</b> {escape(entry.get("caption", ""))}</figcaption></figure>')


def csv_table(folder, entry):
    """The first rows of a CSV file. What is the same in all rows is in the caption instead of a column."""
    path = os.path.join(folder, entry["csv"])
    if not os.path.exists(path):
        return f'<p class="muted">{escape(entry["csv"])} is not here.</p>'
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    columns = entry.get("columns") or (list(rows[0]) if rows else [])
    same = [column for column in columns[1:] if len(rows) > 1 and len({row.get(column, "") for row in rows}) == 1]
    columns = [column for column in columns if column not in same]
    shown = [[row.get(column, "") for column in columns] for row in rows[:MOST_ROWS]]
    notes = [f"{len(rows)} rows" + (f", the first {MOST_ROWS} shown" if len(rows) > MOST_ROWS else "")]
    notes += [f'{column.replace("_", " ")} {rows[0][column]}' for column in same if rows[0].get(column)]
    return (f'<details><summary>{escape(entry.get("title", entry["csv"]))} ({escape("; ".join(notes))}; all columns in '
            f'{escape(entry["csv"])})</summary>{table(columns, shown)}</details>')


def section(folder, name, content):
    parts = [f'<section id="{escape(name)}"><h2>{escape(content["title"])}</h2>']
    parts += [paragraph(text) for text in content.get("text", [])]
    for i, entry in enumerate(content.get("charts", [])):
        if entry.get("heading"):
            parts.append(f'<h3>{escape(entry["heading"])}</h3>')
        parts.append(chart(folder, entry, f"{name}-{i}-"))
    parts += [csv_table(folder, entry) for entry in content.get("tables", [])]
    return "\n".join(parts) + "</section>"


def summaries(sections):
    parts = ['<section id="summary"><h2>Summary</h2>']
    for name, content in sections:
        summary = content.get("summary")
        if summary:
            parts.append(f'<h3><a href="#{escape(name)}">{escape(content["title"])}</a></h3>')
            parts += [paragraph(text) for text in summary.get("text", [])]
            parts.append(table(summary["columns"], summary["rows"]))
            if summary.get("note"):
                parts.append(f'<p class="muted">{escape(summary["note"])}</p>')
    return "\n".join(parts) + "</section>" if len(parts) > 1 else ""


def provenance(folder, sections):
    parts = ['<section id="provenance"><h2>Provenance</h2>']
    made = [(name, content, read_json(os.path.join(folder, name + ".provenance.json"))) for name, content in sections]
    keys = []
    for _, content, values in made:
        values.update(content.get("provenance") or {})
        keys += [key for key in values if key not in keys and key != "command"]
    if not any(values for _, _, values in made):
        return ""
    rows = [[key] + [str(values.get(key, "")) for _, _, values in made] for key in keys]
    parts.append(table([""] + [name for name, _, _ in made], rows, text_only=True))
    commands = [values["command"] for _, _, values in made if values.get("command")]
    if commands:
        parts.append("<h3>Commands</h3><pre>" + "\n".join(escape(command) for command in commands) + "</pre>")
        parts.append("<p>Run these in the folder of Phlux as <code>./phlux</code>, with <code>--out DIR</code>. If DIR is the folder of this "
                     "report, results that it already contains are not measured again.</p>")
    return "\n".join(parts) + "</section>"


def read_json(path):
    if not os.path.exists(path):
        return {}
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def page(folder):
    sections = []
    for path in glob.glob(os.path.join(glob.escape(folder), "*.section.json")):
        sections.append((os.path.basename(path)[:-len(".section.json")], read_json(path)))
    sections.sort(key=lambda entry: (entry[1].get("order", 99), entry[0]))
    links = "".join(f'<a href="#{escape(name)}">{escape(content["title"])}</a>' for name, content in sections)
    body = "\n".join([summaries(sections)] + [section(folder, name, content) for name, content in sections]
                     + [provenance(folder, sections)])
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy" content="{POLICY}">
<link rel="icon" href="data:,">
<title>Phlux: measurements</title>
<style>{STYLE}</style>
</head>
<body>
<h1>Phlux: measurements</h1>
<nav>{links}<a href="#provenance">Provenance</a></nav>
{body}
</body>
</html>
"""


def main():
    folder = sys.argv[1]
    path = os.path.join(folder, "index.html")
    with open(path + ".tmp", "w", encoding="utf-8") as file:
        file.write(page(folder))
    os.replace(path + ".tmp", path)


if __name__ == "__main__":
    main()
