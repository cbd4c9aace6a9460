#pragma once
namespace std_msgs { namespace msg { struct String {}; } }
