"use strict";

const figures = [...document.querySelectorAll("figure[data-plot]")].map((figure) => new ReportFigure(figure));
const redraw = (width) => figures.forEach((figure) => figure.draw(width));

// a plot that was drawn while its part was folded away knows no width
document.querySelectorAll("details.folded").forEach((part) => part.addEventListener("toggle", () => redraw()));

// at #summary the report is one page
const choosePage = () => {
  if (location.hash === "#summary") document.documentElement.dataset.view = "summary";
  else delete document.documentElement.dataset.view;
  redraw();
};
addEventListener("hashchange", choosePage);
choosePage();

document.getElementById("theme").addEventListener("click", () => { colors.switchTheme(); redraw(); });
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => redraw());

// Paper is white and, in A4 without its margins, 182 mm wide: 688 CSS pixels.
addEventListener("beforeprint", () => {
  colors.chosen = document.documentElement.dataset.theme;
  document.documentElement.dataset.theme = "light";
  redraw(688);
});

addEventListener("afterprint", () => {
  if (colors.chosen) document.documentElement.dataset.theme = colors.chosen;
  else delete document.documentElement.dataset.theme;
  redraw();
});
