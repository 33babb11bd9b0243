/** Files dropped on the page, or chosen by the file field. `open(file)`. */
export function listenToFiles(hint, field, open) {
  let depth = 0; // of the elements that a file is dragged over
  const show = (change) => {
    depth = Math.max(0, depth + change);
    hint.hidden = depth === 0;
  };
  const holdsFiles = (event) => event.dataTransfer?.types.includes("Files");
  addEventListener("dragenter", (event) => holdsFiles(event) && show(1));
  addEventListener("dragleave", (event) => holdsFiles(event) && show(-1));
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    show(-depth);
    const file = event.dataTransfer?.files[0];
    if (file) open(file);
  });
  field.addEventListener("change", () => {
    if (field.files[0]) open(field.files[0]);
    field.value = "";
  });
}
