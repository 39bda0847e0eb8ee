"use strict";
// Buttons that copy: without a script the texts can be selected as any others.
for (const source of document.querySelectorAll(".source")) {
  const text = source.querySelector("code");
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = "Copy";
  button.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(text.textContent);
      button.textContent = "Copied";
    } catch {
      // where the clipboard is closed to pages, the text is at least selected
      getSelection().selectAllChildren(text);
      button.textContent = "Selected";
    }
    setTimeout(() => { button.textContent = "Copy"; }, 1500);
  });
  source.append(button);
}
