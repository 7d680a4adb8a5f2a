// The page can be read first: plotly.js takes a second. Then one plot after the other, what is in sight first.
addEventListener("load", () => requestAnimationFrame(() => setTimeout(() => {
  const code = document.createElement("script");
  code.textContent = document.getElementById("plotly").textContent;
  document.head.append(code);
  const sight = ({ place }) => {
    const { top, bottom } = place.getBoundingClientRect();
    return Math.max(0, top - innerHeight, -bottom);
  };
  for (const data of document.querySelectorAll("script.plot-data")) {
    const place = document.getElementById(data.dataset.plot);
    const draw = () => {
      const { data: traces, layout, config } = JSON.parse(data.textContent);
      return Plotly.newPlot(place, traces, layout, config);
    };
    drawLater.push({ place, draw });
  }
  const left = drawLater.map((it, at) => [sight(it), at, it]).sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const one = async () => {
    const [, , { place, draw }] = left.shift();
    await draw();
    place.dispatchEvent(new Event("drawn"));
  };
  const on = async () => {
    while (left.length && !left[0][0]) await one();
    // A frame first, so that what is in sight is seen.
    if (left.length) requestAnimationFrame(() => setTimeout(async () => { if (left.length) await one(); on(); }));
  };
  addEventListener("beforeprint", () => { while (left.length) one(); });
  on();
})));
