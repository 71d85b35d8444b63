"use strict";

// The data of a figure: columns of a tidy table, to which the traces refer.
const columns = {
  shownRows: 200,

  read(encoded) {
    return Array.isArray(encoded) ? encoded : encoded.repeat.flatMap(([value, count]) => Array(count).fill(value));
  },

  isReference(item) {
    return item !== null && typeof item === "object" && "column" in item && "rows" in item;
  },

  follow(trace, table) {
    const entries = Object.entries(trace).map(([key, value]) =>
      columns.isReference(value) ? [key, table[value.column].slice(...value.rows)] : [key, value]);
    return Object.fromEntries(entries);
  },

  // rows without any number only lift the pen between two pieces of a line
  rows(table) {
    const all = Object.values(table);
    const hasNumber = (index) => all.some((values) => typeof values[index] === "number");
    const indices = [...(all[0] || []).keys()].filter(hasNumber);
    return indices.map((index) => all.map((values) => values[index]));
  },

  csvCell(value) {
    if (value === null || value === undefined) return "";
    if (typeof value === "number") return String(value);
    const harmless = /^[=+\-@\t\r]/.test(value) ? "'" + value : value;
    return /[",\r\n]/.test(harmless) ? '"' + harmless.replaceAll('"', '""') + '"' : harmless;
  },

  csv(table) {
    const lines = [Object.keys(table), ...columns.rows(table)];
    return "\ufeff" + lines.map((line) => line.map(columns.csvCell).join(",")).join("\r\n") + "\r\n";
  },

  save(title, table) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([columns.csv(table)], { type: "text/csv" }));
    link.download = title.toLowerCase().replace(/[^a-z0-9]+/g, "_") + ".csv";
    link.click();
    URL.revokeObjectURL(link.href);
  },

  element(kind, text = "", parent = null) {
    const made = document.createElement(kind);
    made.textContent = text;
    if (parent) parent.append(made);
    return made;
  },

  show(place, title, table) {
    const rows = columns.rows(table);
    const button = columns.element("button", "CSV", place);
    button.type = "button";
    button.className = "save";
    button.addEventListener("click", () => columns.save(title, table));
    const more = rows.length > columns.shownRows;
    columns.element("span", more ? ` the first ${columns.shownRows} of ${rows.length} rows; all in the file` : "", place);
    const shown = columns.element("table", "", place);
    const head = columns.element("tr", "", shown);
    Object.keys(table).forEach((heading) => columns.element("th", heading, head));
    rows.slice(0, columns.shownRows).forEach((row) => columns.showRow(shown, row));
  },

  showRow(shown, row) {
    const line = columns.element("tr", "", shown);
    row.forEach((value) => {
      const cell = columns.element("td", value === null || value === undefined ? "–" : String(value), line);
      if (typeof value === "number") cell.className = "number";
    });
  },
};
