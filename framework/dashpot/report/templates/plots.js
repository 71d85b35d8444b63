"use strict";

// One figure of the report: its plot, the buttons above it, the data below it.
class ReportFigure {
  static low = 380; // pixels of a plot on the one page
  static config = { displaylogo: false, responsive: true, modeBarButtonsToRemove: ["select2d", "lasso2d", "sendDataToCloud"] };

  constructor(figure) {
    const content = JSON.parse(document.getElementById(figure.dataset.plot).textContent);
    this.title = content.title;
    this.plot = figure.querySelector(".plot");
    this.table = Object.fromEntries(Object.entries(content.columns).map(([key, values]) => [key, columns.read(values)]));
    this.traces = content.data.map((trace) => columns.follow(trace, this.table));
    this.layout = content.layout;
    this.groups = (content.layout.meta || {}).toggles || [];
    this.addButtons(figure.querySelector(".toggles"));
    this.addData(figure.querySelector("details"));
    this.draw();
  }

  draw(width = undefined) {
    const layout = { ...colors.resolve(this.layout), autosize: width === undefined, width, uirevision: "kept" };
    if (document.documentElement.dataset.view === "summary") layout.height = Math.min(layout.height, ReportFigure.low);
    if (this.groups.length) layout.showlegend = false;
    const traces = colors.resolve(this.traces).map((trace) => ({ ...trace, visible: this.isShown(trace) }));
    return Plotly.react(this.plot, traces, layout, ReportFigure.config);
  }

  isShown(trace) {
    const meta = trace.meta || {};
    return this.groups.every((group) => group.choices.every((choice) => meta[group.key] !== choice.value || choice.shown));
  }

  addButtons(place) {
    this.buttons = [];
    for (const group of this.groups) {
      const row = columns.element("div", "", place);
      row.className = "row";
      columns.element("span", group.title, row);
      group.choices.forEach((choice) => this.addChoice(row, group, choice));
      if (group.choices.length > 3) this.addEvery(row, group);
    }
    this.markButtons();
  }

  addChoice(row, group, choice) {
    const button = columns.element("button", "", row);
    button.type = "button";
    if (choice.mark) {
      const mark = columns.element("span", "", button);
      mark.className = "mark " + choice.mark;
      mark.style.setProperty("--mark", `var(--${choice.color.slice(1)})`);
    }
    button.append(choice.label);
    button.addEventListener("click", () => this.change(() => { choice.shown = !choice.shown; }));
    button.addEventListener("dblclick", () => this.change(() => group.choices.forEach((each) => { each.shown = each === choice; })));
    this.buttons.push([button, choice]);
  }

  addEvery(row, group) {
    const button = columns.element("button", "all", row);
    button.type = "button";
    button.className = "every";
    button.addEventListener("click", () => this.change(() => group.choices.forEach((each) => { each.shown = true; })));
  }

  change(edit) {
    edit();
    this.markButtons();
    this.draw();
  }

  markButtons() {
    this.buttons.forEach(([button, choice]) => button.setAttribute("aria-pressed", String(choice.shown)));
  }

  addData(details) {
    details.addEventListener("toggle", () => {
      const place = details.querySelector(".rows");
      if (details.open && !place.childElementCount) columns.show(place, this.title, this.table);
    });
  }
}
