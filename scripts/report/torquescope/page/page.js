// The switch between light and dark, legends that hide lines, and the buttons that copy. Without this script the page
// shows its first pictures.
const root = document.documentElement;
document.getElementById("theme").addEventListener("click", () => {
  const dark = root.dataset.theme
    ? root.dataset.theme === "dark"
    : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = dark ? "light" : "dark";
});

// the entry of a legend becomes a button that hides what it names; "e0" hides "measured-e0" too
function makeLegend(figure) {
  figure.hiddenParts = new Set();
  figure.querySelectorAll(".keys [data-hides]").forEach((entry) => {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "key";
    button.setAttribute("aria-pressed", "true");
    button.append(...entry.childNodes);
    entry.replaceWith(button);
    button.addEventListener("click", () => {
      const shown = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", String(shown));
      for (const part of entry.dataset.hides.split(" ")) {
        figure.hiddenParts[shown ? "delete" : "add"](part);
        const drawn = figure.querySelectorAll(`svg [data-part="${part}"]`);
        drawn.forEach((one) => (one.style.display = shown ? "" : "none"));
      }
    });
  });
}

// a button copies the text it names; where this page has no clipboard it opens the fold that shows the text
document.querySelectorAll("button[data-copies]").forEach((button) => {
  button.addEventListener("click", async () => {
    const told = button.nextElementSibling;
    try {
      await navigator.clipboard.writeText(document.getElementById(button.dataset.copies).textContent);
      told.textContent = "copied";
    } catch {
      told.textContent = "";
      const fold = button.parentElement.nextElementSibling;
      if (fold?.tagName === "DETAILS") fold.open = true;
      else told.textContent = "no clipboard here: mark the text and copy it";
    }
  });
});

document.querySelectorAll("figure").forEach((figure) => {
  makeLegend(figure);
  const chart = figure.querySelector(".chart");
  if (chart) makeReadable(figure, chart);
  if (figure.querySelector(".trace") && "DecompressionStream" in window) makeZoomable(figure);
});
