// drop_file WINDOW FILE: drags FILE onto an X11 window and drops it there, as a file manager does (the XDND
// protocol, version 5). Fails when the window does not take it within ten seconds.
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

Display* display;
Window source, target;

Atom atom(const char* name) {
    return XInternAtom(display, name, False);
}

void send(const char* type, long a, long b = 0, long c = 0, long d = 0) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target;
    event.xclient.message_type = atom(type);
    event.xclient.format = 32;
    const long values[] = {static_cast<long>(source), a, b, c, d};
    for (int i = 0; i < 5; ++i) event.xclient.data.l[i] = values[i];
    XSendEvent(display, target, False, NoEventMask, &event);
    XFlush(display);
}

// Gives the list of one file to whoever asks for it.
void answer(const XSelectionRequestEvent& request, const std::string& list) {
    XChangeProperty(display, request.requestor, request.property, request.target, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(list.data()), static_cast<int>(list.size()));
    XEvent event{};
    event.xselection.type = SelectionNotify;
    event.xselection.requestor = request.requestor;
    event.xselection.selection = request.selection;
    event.xselection.target = request.target;
    event.xselection.property = request.property;
    event.xselection.time = request.time;
    XSendEvent(display, request.requestor, False, NoEventMask, &event);
    XFlush(display);
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 3 || !(display = XOpenDisplay(nullptr))) return 2;
    target = std::strtoul(arguments[1], nullptr, 0);
    const std::string list = "file://" + std::string(arguments[2]) + "\r\n";
    source = XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0);
    XSetSelectionOwner(display, atom("XdndSelection"), source, CurrentTime);
    send("XdndEnter", 5L << 24, static_cast<long>(atom("text/uri-list")));
    send("XdndPosition", 0, 100L << 16 | 100, CurrentTime, static_cast<long>(atom("XdndActionCopy")));
    bool dropped = false;
    for (int wait = 0; wait < 1000; ++wait) {
        while (XPending(display) > 0) {
            XEvent event;
            XNextEvent(display, &event);
            if (event.type == SelectionRequest) answer(event.xselectionrequest, list);
            if (event.type != ClientMessage) continue;
            if (event.xclient.message_type == atom("XdndFinished")) return 0;
            if (event.xclient.message_type == atom("XdndStatus") && !dropped) {
                dropped = true;
                send("XdndDrop", 0, CurrentTime);
            }
        }
        usleep(10000);
    }
    std::fprintf(stderr, "drop_file: the window did not take %s\n", arguments[2]);
    return 1;
}
