#!/usr/bin/env python3
"""Each chart of docs/media is drawn from the table in bench/results that has its name: of the same case and the same
commit."""
import csv
import io
import re

from repo_files import conclude, project_files, read_text

TABLE = "bench/results/xeon-2-cores/{}.csv"


def faults_of_chart(name, drawing, table):
    if table is None:
        return [f"{name}.svg: {TABLE.format(name)} is not there: keep the table that it is drawn from"]
    rows = [row for row in csv.DictReader(io.StringIO(table)) if row["scheme"] != "reference"]
    printed = re.search(r"commit ([0-9a-f]+\+?)", drawing)
    commits = {row["commit"] for row in rows}
    faults = []
    if not printed or commits != {printed.group(1)}:
        faults.append(f"{name}.svg: drawn at commit {printed and printed.group(1)}, its table measured at {', '.join(sorted(commits))}")
    if not any(f">{row['case']}<" in drawing for row in rows[:1]):
        faults.append(f"{name}.svg: it is no drawing of the case {rows[0]['case'] if rows else 'of its table'}")
    return faults


def main():
    files = set(project_files())
    charts = sorted(path for path in files if re.fullmatch(r"docs/media/chart-[\w-]+\.svg", path))
    faults = [] if charts else ["there is no chart in docs/media"]
    for path in charts:
        name = path.rsplit("/", 1)[-1][: -len(".svg")]
        table = TABLE.format(name)
        faults += faults_of_chart(name, read_text(path), read_text(table) if table in files else None)
    conclude(f"{len(charts)} charts", faults)


if __name__ == "__main__":
    main()
