// Light or dark: as the system has it, until the visitor says otherwise.

const THEMES = ["system", "light", "dark"];

/** Makes a button go through the themes, and remembers the last one where the browser lets it. */
export function showThemes(button) {
  const read = () => {
    try {
      return localStorage.getItem("straightline-theme");
    } catch {
      return null;
    }
  };
  let theme = THEMES.includes(read()) ? read() : "system";
  const show = () => {
    document.documentElement.dataset.theme = theme;
    button.title = `Colours: ${theme}`;
    button.ariaLabel = `Colours: ${theme}. Change`;
    button.textContent = { system: "◐", light: "☀", dark: "☾" }[theme];
  };
  button.addEventListener("click", () => {
    theme = THEMES[(THEMES.indexOf(theme) + 1) % THEMES.length];
    try {
      localStorage.setItem("straightline-theme", theme);
    } catch {
      // It lasts as long as the page.
    }
    show();
  });
  show();
}
