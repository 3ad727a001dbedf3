// A browser that has no modules by a map or no colours of both schemes keeps the plain summary.
(function () {
  var has = window.CSS && CSS.supports("color", "light-dark(#000, #fff)") && Object.groupBy && [].toSorted
    && HTMLScriptElement.supports && HTMLScriptElement.supports("importmap");
  if (has) document.documentElement.className = "alive";
  else document.getElementById("old").textContent =
    "Браузер слишком старый для живой страницы: нужен Chrome 123, Firefox 121, Safari 17.5 или новее.";
})();
