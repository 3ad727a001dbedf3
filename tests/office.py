"""LibreOffice without a window, driven from the system's Python, which has ``uno``."""

import contextlib
import subprocess
import time

import uno
from com.sun.star.beans import PropertyValue
from com.sun.star.connection import NoConnectException


def prop(name, value):
    """A property of a call to LibreOffice."""
    setting = PropertyValue()
    setting.Name, setting.Value = name, value
    return setting


@contextlib.contextmanager
def desktop(profile):
    """The desktop of a LibreOffice with a profile of its own, until the block ends."""
    pipe = f"kshm{abs(hash(profile))}"
    office = subprocess.Popen(
        ["soffice", "--headless", "--norestore", f"-env:UserInstallation=file://{profile}",
         f"--accept=pipe,name={pipe};urp;"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    manager = uno.getComponentContext().ServiceManager
    resolver = manager.createInstance("com.sun.star.bridge.UnoUrlResolver")
    for _ in range(200):
        try:
            context = resolver.resolve(f"uno:pipe,name={pipe};urp;StarOffice.ComponentContext")
            break
        except NoConnectException:
            time.sleep(0.3)
    root = context.ServiceManager.createInstanceWithContext("com.sun.star.frame.Desktop", context)
    yield root
    with contextlib.suppress(Exception):  # the bridge breaks when the office goes
        root.terminate()
    office.wait(30)
