// A button on each block of code that copies its text; without JavaScript, or on a page that may not use the clipboard, there is none.

document.addEventListener("DOMContentLoaded", function () {
  if (!navigator.clipboard && !document.queryCommandSupported("copy")) return;

  function copy(text) {
    if (navigator.clipboard) return navigator.clipboard.writeText(text);
    // pages from a file, not from a server, in some browsers
    const area = document.createElement("textarea");
    area.value = text;
    document.body.appendChild(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done ? Promise.resolve() : Promise.reject();
  }

  document.querySelectorAll("div[class^='highlight-']").forEach(function (block) {
    const text = block.querySelector("pre").textContent;
    const button = document.createElement("button");
    button.className = "copy";
    button.type = "button";
    button.textContent = "Copy";
    button.setAttribute("aria-label", "Copy this code");
    button.addEventListener("click", function () {
      copy(text).then(() => "Copied", () => "Not copied").then(function (word) {
        button.textContent = word;
        setTimeout(() => { button.textContent = "Copy"; }, 2000);
      });
    });
    block.appendChild(button);
  });
});
