/** Keys of the page. Those typed into fields are not its own; a slider keeps its arrows, a button its space. */
export function listenToKeys(actions) {
  addEventListener("keydown", (event) => {
    const { key, target } = event;
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (target.matches("input:not([type=range]):not([type=checkbox]), select, textarea, dialog *")) return;
    if (target.matches("input[type=range]") && key.startsWith("Arrow")) return;
    if (target.matches("button, summary, input[type=checkbox]") && (key === " " || key === "Enter")) return;
    const action = actions[key.length === 1 ? key.toLowerCase() : key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
