"use strict";

// A plot names its colours "@before"; the page says what that is for the reader's light or dark, and on paper.
const colors = {
  chosen: undefined,

  isDark() {
    const chosen = document.documentElement.dataset.theme;
    return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  },

  switchTheme() {
    document.documentElement.dataset.theme = colors.isDark() ? "light" : "dark";
  },

  look(name) {
    return getComputedStyle(document.documentElement).getPropertyValue("--" + name.slice(1)).trim();
  },

  isName(key, value) {
    return typeof value === "string" && value.startsWith("@") && /color(scale)?$/.test(key);
  },

  resolve(item, key = "") {
    if (colors.isName(key, item)) return colors.look(item);
    if (Array.isArray(item)) {
      return item.length && typeof item[0] === "number" ? colors.resolvePair(item, key) : item.map((each) => colors.resolve(each, key));
    }
    if (item === null || typeof item !== "object") return item;
    return Object.fromEntries(Object.entries(item).map(([name, value]) => [name, colors.resolve(value, name)]));
  },

  // [0.25, "@heat-2"] of a colour scale; any other list of numbers stays as it is
  resolvePair(item, key) {
    return key === "colorscale" ? [item[0], colors.resolve(item[1], key)] : item;
  },
};
