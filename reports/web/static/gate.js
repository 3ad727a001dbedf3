// The page comes alive in a browser that can do all it needs; an old one keeps what stands here, and a sentence.
(function () {
  var here = document.currentScript, has = window.CSS && CSS.supports("color", "light-dark(#000, #fff)") && Object.groupBy && [].toSorted
    && HTMLScriptElement.supports && HTMLScriptElement.supports("importmap");
  if (!has) {
    document.getElementById("old").textContent =
      "Браузер слишком старый для этой страницы: нужен Chrome 123, Firefox 121, Safari 17.5 или новее.";
    return;
  }
  var main = document.createElement("script");
  main.type = "module";
  if (here.getAttribute("data-src")) main.src = here.getAttribute("data-src");
  else main.text = here.getAttribute("data-text");
  document.documentElement.className = "alive";
  document.head.appendChild(main);
})();
