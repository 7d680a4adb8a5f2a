(() => {
  const here = document.currentScript.closest(".explorer");
  const said = JSON.parse(here.querySelector("script[type='application/json']").textContent);
  const [rows, columns] = here.querySelectorAll("select");
  const [back, on] = here.querySelectorAll("button");
  const plot = document.getElementById("plot-" + said.name);
  const full = (it) => {
    if (it === null || typeof it !== "object") return it;
    if (Array.isArray(it)) return it.map(full);
    if ("$" in it) return full(said.pool[it.$]);
    return Object.fromEntries(Object.entries(it).map(([key, value]) => [key, full(value)]));
  };
  const fill = (list, names, kept) => {
    list.replaceChildren(...names.map((name) => new Option(name, name)));
    if (names.includes(kept)) list.value = kept;
  };
  const show = () => {
    const [, , found] = said.plots.find(([row, column]) => row === rows.value && column === columns.value);
    const whole = full(found);
    return Plotly.react(plot, whole.data, whole.layout, said.config);
  };
  const choose = (row, column) => {
    rows.value = row;
    fill(columns, said.plots.filter(([name]) => name === row).map(([, name]) => name), column);
    return show();
  };
  const step = (by) => {
    const at = said.plots.findIndex(([row, column]) => row === rows.value && column === columns.value);
    const [row, column] = said.plots[(at + by + said.plots.length) % said.plots.length];
    choose(row, column);
  };
  fill(rows, [...new Set(said.plots.map(([row]) => row))]);
  rows.addEventListener("change", () => choose(rows.value, columns.value));
  columns.addEventListener("change", show);
  back.addEventListener("click", () => step(-1));
  on.addEventListener("click", () => step(1));
  drawLater.push({ place: plot, draw: () => choose(...said.first) });
  const map = document.getElementById(said.linked);
  if (map) map.addEventListener("drawn", () => map.on("plotly_click", (event) => {
    const [y, x] = event.points[0].customdata;
    if (!said.plots.some(([row, column]) => row === y && column === x)) return;
    choose(y, x);
    here.scrollIntoView({ behavior: "smooth", block: "start" });
  }));
})();
